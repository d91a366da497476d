// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_rrt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "microswarm/geometry/bucket_kd_tree.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/global_input/global_separation.hpp"

namespace microswarm::planning {
namespace {

constexpr int max_place_draws = 10'000;   // per position of one robot
constexpr std::uint64_t asks_every = 16;  // iterations, each about 10 µs

constexpr std::size_t max_reserved = 1 << 20;  // nodes

using GrownPlaces = std::array<float, 2 * max_global_robots>;

class Growth {
 public:
  Growth(const Map& map, const RobotStepper& stepper, std::span<const Vec2> starts,
         std::span<const Vec2> goals, const GlobalRrtParams& params, Rng& rng)
      : map_(map),
        stepper_(stepper),
        separation_(stepper, params.contact, params.separation),
        goals_(goals),
        params_(params),
        rng_(rng),
        n_(starts.size()),
        nearest_(2 * n_),
        sums_(static_cast<std::size_t>(params.directions)),
        reached_(n_ * sums_.size()) {
    GlobalTree& tree = grown_.tree;
    tree.robots = n_;
    tree.origin = map.bounds().centre();
    tree.robostep = params.robostep;
    tree.contact = params.contact;
    tree.separation = params.separation;
    tree.moves = input_moves(params.directions, params.robostep);
    add(relative(starts), 0, 0);
  }

  GlobalRrt just_root() { return std::move(grown_); }

  // Alg 1 [global].
  GlobalRrt run(const Stop& stop) {
    const auto max_nodes = static_cast<std::size_t>(params_.max_nodes);
    const auto max_iterations = static_cast<std::uint64_t>(params_.max_iterations);
    GoalAnswer& answer = grown_.answer;
    std::uint64_t& iteration = grown_.counts.iterations;
    grown_.tree.reserve(std::min(max_nodes, max_reserved));
    for (; grown_.tree.size() < max_nodes && iteration < max_iterations; ++iteration) {
      if (params_.stop_at_first && answer.status == Status::solved) break;
      if (iteration % asks_every == 0) {
        if (const auto told = stop.status()) {
          if (answer.status != Status::solved) answer.status = *told;
          break;
        }
      }
      const std::optional<GrownPlaces> sample = sample_free();
      if (!sample) continue;
      extend(nearest_.nearest(used(*sample)), *sample);
    }
    return std::move(grown_);
  }

 private:
  std::span<const float> used(const GrownPlaces& c) const { return {c.data(), 2 * n_}; }

  GrownPlaces relative(std::span<const Vec2> positions) const {
    GrownPlaces c{};
    for (std::size_t i = 0; i < n_; ++i) put(c, i, stepper_.relative(positions[i]));
    return c;
  }

  static void put(GrownPlaces& c, std::size_t robot, PointF p) {
    c[2 * robot] = p.x;
    c[2 * robot + 1] = p.y;
  }

  std::optional<GrownPlaces> sample_free() {
    ++grown_.counts.samples;
    if (params_.goal_bias > 0 && !goals_.empty() && rng_.uniform() < params_.goal_bias)
      return relative(goals_);
    const Box& bounds = map_.bounds();
    GrownPlaces c{};
    for (std::size_t i = 0; i < n_; ++i) {
      int draws = 0;
      Vec2 p;
      do {
        if (++draws > max_place_draws) return std::nullopt;
        p = uniform_in(bounds, rng_);
      } while (!map_.is_free(p, 0));
      put(c, i, stepper_.relative(p));
    }
    return c;
  }

  // Alg 2 [global]: the input that gets nearest to the target, computed robot by robot.
  void extend(std::uint32_t from, const GrownPlaces& target) {
    const std::vector<PointF>& moves = grown_.tree.moves;
    const std::span<const float> start = grown_.tree.configuration(from);
    std::ranges::fill(sums_, 0.0f);
    for (std::size_t i = 0; i < n_; ++i) {
      const PointF p{start[2 * i], start[2 * i + 1]};
      PointF* reached = reached_.data() + i * moves.size();
      if (stepper_.faces().near(p).empty()) {
        for (std::size_t a = 0; a < moves.size(); ++a)
          reached[a] = {p.x + moves[a].x, p.y + moves[a].y};
      } else {
        stepper_.moved(p, moves, params_.contact, {reached, moves.size()});
      }
      for (std::size_t a = 0; a < moves.size(); ++a) {
        const float dx = reached[a].x - target[2 * i];
        const float dy = reached[a].y - target[2 * i + 1];
        sums_[a] += dx * dx + dy * dy;
      }
    }
    grown_.counts.edge_checks += moves.size();
    auto best = std::ranges::min_element(sums_);
    while (!keeps_apart(from, static_cast<std::size_t>(best - sums_.begin()))) {
      *best = std::numeric_limits<float>::infinity();
      best = std::ranges::min_element(sums_);
      if (std::isinf(*best)) return;
    }
    const auto input = static_cast<std::size_t>(best - sums_.begin());
    GrownPlaces next{};
    for (std::size_t i = 0; i < n_; ++i) put(next, i, reached_[i * moves.size() + input]);
    if (std::ranges::equal(used(next), start)) return;
    add(next, from, static_cast<std::uint8_t>(input));
  }

  bool keeps_apart(std::uint32_t node, std::size_t input) const {
    if (!separation_.is_on()) return true;
    const std::span<const float> start = grown_.tree.configuration(node);
    std::array<PointF, max_global_robots> before, after;
    for (std::size_t i = 0; i < n_; ++i) {
      before[i] = {start[2 * i], start[2 * i + 1]};
      after[i] = reached_[i * sums_.size() + input];
    }
    return separation_.holds({before.data(), n_}, {after.data(), n_}, grown_.tree.moves[input]);
  }

  void add(const GrownPlaces& c, std::uint32_t parent, std::uint8_t input) {
    GlobalTree& tree = grown_.tree;
    const auto node = static_cast<std::uint32_t>(tree.size());
    tree.add(used(c), parent, input);
    nearest_.add(used(c));
    if (goals_.empty()) return;
    double worst = 0;
    for (std::size_t i = 0; i < n_; ++i)
      worst = std::max(worst, distance(tree.position(node, i), goals_[i]));
    if (node > 0 && worst >= grown_.answer.worst) return;
    grown_.answer.node = node;
    grown_.answer.worst = worst;
    if (worst <= params_.goal_tolerance) grown_.answer.status = Status::solved;
  }

  const Map& map_;
  const RobotStepper& stepper_;
  GlobalSeparation separation_;
  std::span<const Vec2> goals_;
  const GlobalRrtParams& params_;
  Rng& rng_;
  std::size_t n_;
  GlobalRrt grown_;
  BucketKdTree nearest_;
  std::vector<float> sums_;
  std::vector<PointF> reached_;
};

double min_distance(std::span<const Vec2> positions) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, distance(positions[i], positions[j]));
  return least;
}

}  // namespace

std::optional<Status> robots_fault(const Map& map, std::span<const Vec2> starts,
                                   std::span<const Vec2> goals, double tolerance, double guard,
                                   double separation) {
  for (const Vec2 p : starts)
    if (!is_finite(p) || !map.is_free(p, guard)) return Status::start_blocked;
  if (min_distance(starts) < separation) return Status::start_blocked;
  const Snapshot world = Snapshot::of(map);
  for (const Vec2 p : goals)
    if (!free_goal(world, p, tolerance, 0)) return Status::goal_blocked;
  if (min_distance(goals) + 2 * tolerance < separation) return Status::goal_blocked;
  return std::nullopt;
}

GlobalRrt global_rrt(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                     const GlobalRrtParams& params, Rng& rng, const Stop& stop) {
  check_robots(starts, goals);
  const RobotStepper stepper = input_stepper(map, params.robostep);
  const std::optional<Status> fault =
      robots_fault(map, starts, goals, params.goal_tolerance, stepper.guard(), params.separation);
  if (fault == Status::start_blocked) return {{Status::start_blocked}, {}, {}};
  Growth growth(map, stepper, starts, goals, params, rng);
  if (!fault) return growth.run(stop);
  GlobalRrt root = growth.just_root();
  root.answer.status = *fault;
  return root;
}

}  // namespace microswarm::planning
