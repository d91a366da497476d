// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_shorten.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "microswarm/planning/global_input/global_separation.hpp"

namespace microswarm::planning {
namespace {

constexpr int max_shorten_rounds = 20;

using PlayedPlaces = std::vector<PointF>;

/// `count` equal inputs starting at `first`.
struct Run {
  std::size_t first;
  std::size_t count;
};

class Shortening {
 public:
  Shortening(const Map& map, const GlobalPlan& plan, std::span<const Vec2> goals,
             const GlobalPlay& play, const Stop& stop)
      : play_(play),
        stepper_(input_stepper(map, play.robostep)),
        separation_(stepper_, play.contact, play.separation),
        stop_(stop),
        n_(goals.size()),
        origin_(map.bounds().centre()) {
    for (const Vec2 goal : goals) goals_.push_back(stepper_.relative(goal));
    for (const Vec2 u : plan.inputs)
      inputs_.push_back({static_cast<float>(u.x), static_cast<float>(u.y)});
    PlayedPlaces start;
    for (const Vec2 p : plan.configurations[0]) start.push_back(stepper_.relative(p));
    states_.push_back(start);
    for (const PointF u : inputs_) {
      PlayedPlaces next = states_.back();
      step(next, u);
      states_.push_back(next);
    }
  }

  void run() {
    for (int round = 0; round < max_shorten_rounds && !stop_(); ++round) {
      const std::size_t before = inputs_.size();
      for (std::size_t length = std::max<std::size_t>(1, inputs_.size() / 2);; length /= 2) {
        drop_stretches(length);
        if (length == 1) break;
      }
      drop_pairs();
      if (inputs_.size() == before) break;
    }
  }

  GlobalPlan plan() const {
    GlobalPlan plan{Status::solved, {}, {}, worst(states_.back())};
    for (const PointF u : inputs_)
      plan.inputs.push_back({static_cast<double>(u.x), static_cast<double>(u.y)});
    for (const PlayedPlaces& robots : states_) {
      std::vector<Vec2>& positions = plan.configurations.emplace_back();
      for (std::size_t i = 0; i < n_; ++i)
        positions.push_back(
            origin_ + Vec2{static_cast<double>(robots[i].x), static_cast<double>(robots[i].y)});
    }
    return plan;
  }
  bool reaches() const { return worst(states_.back()) <= play_.goal_tolerance; }

 private:
  /// False if robots come too close to each other.
  bool step(PlayedPlaces& robots, PointF u) {
    before_ = robots;
    for (std::size_t i = 0; i < n_; ++i) {
      const PointF p = robots[i];
      robots[i] = stepper_.faces().near(p).empty() ? PointF{p.x + u.x, p.y + u.y}
                                                   : stepper_.moved(p, u, play_.contact);
    }
    return separation_.holds(before_, robots, u);
  }

  double worst(const PlayedPlaces& robots) const {
    double square = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double dx = static_cast<double>(robots[i].x) - static_cast<double>(goals_[i].x);
      const double dy = static_cast<double>(robots[i].y) - static_cast<double>(goals_[i].y);
      square = std::max(square, dx * dx + dy * dy);
    }
    return std::sqrt(square);
  }

  /// Simulates the inputs without `gaps`, which are in order. If the goals are reached, takes the
  /// shorter inputs, up to the first time they are.
  bool try_without(std::span<const Run> gaps) {
    const std::size_t from = gaps[0].first;
    PlayedPlaces robots = states_[from];
    played_.clear();
    reached_.clear();
    bool solved = worst(robots) <= play_.goal_tolerance;
    std::size_t gap = 0;
    for (std::size_t k = from; k < inputs_.size() && !solved;) {
      if (gap < gaps.size() && k == gaps[gap].first) {
        k += gaps[gap++].count;
        continue;
      }
      if (!step(robots, inputs_[k])) return false;
      played_.push_back(inputs_[k++]);
      reached_.insert(reached_.end(), robots.begin(), robots.end());
      solved = worst(robots) <= play_.goal_tolerance;
    }
    if (!solved) return false;
    inputs_.resize(from);
    states_.resize(from + 1);
    inputs_.insert(inputs_.end(), played_.begin(), played_.end());
    for (auto at = reached_.begin(); at != reached_.end(); at += static_cast<std::ptrdiff_t>(n_))
      states_.emplace_back(at, at + static_cast<std::ptrdiff_t>(n_));
    return true;
  }

  void drop_stretches(std::size_t length) {
    for (std::size_t first = 0; first + length <= inputs_.size() && !stop_();)
      if (const Run gap{first, length}; !try_without({&gap, 1}))
        first += std::max<std::size_t>(1, length / 4);
  }

  std::vector<Run> runs() const {
    std::vector<Run> all;
    for (std::size_t k = 0; k < inputs_.size(); ++k) {
      const bool goes_on =
          k > 0 && inputs_[k].x == inputs_[k - 1].x && inputs_[k].y == inputs_[k - 1].y;
      if (goes_on)
        ++all.back().count;
      else
        all.push_back({k, 1});
    }
    return all;
  }

  void drop_pairs() {
    std::vector<Run> all = runs();
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = i + 1; j < all.size() && !stop_(); ++j) {
        std::size_t count = std::min(all[i].count, all[j].count);
        for (; count > 0; count /= 2)
          if (try_without(std::array{Run{all[i].first, count}, Run{all[j].first, count}})) break;
        if (count == 0) continue;
        all = runs();
        if (i >= all.size()) return;
        j = i;
      }
    }
  }

  GlobalPlay play_;
  RobotStepper stepper_;
  GlobalSeparation separation_;
  const Stop& stop_;
  std::size_t n_;
  Vec2 origin_;
  PlayedPlaces goals_;
  std::vector<PointF> inputs_;
  std::vector<PlayedPlaces> states_;  ///< before the first input, and after each
  std::vector<PointF> played_;        ///< inputs of the current attempt
  std::vector<PointF> reached_;       ///< n per input
  PlayedPlaces before_;
};

}  // namespace

GlobalPlan shortened(const Map& map, const GlobalPlan& plan, std::span<const Vec2> goals,
                     const GlobalPlay& play, const Stop& stop) {
  if (plan.status != Status::solved) return plan;
  Shortening shortening(map, plan, goals, play, stop);
  if (!shortening.reaches()) return plan;
  shortening.run();
  return shortening.plan();
}

}  // namespace microswarm::planning
