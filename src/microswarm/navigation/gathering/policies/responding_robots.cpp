// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/responding_robots.hpp"

#include <algorithm>
#include <utility>

namespace microswarm::navigation {
namespace {

constexpr double judged_steps = 16;   // after so many free steps a robot is judged
constexpr double least_share = 0.2;   // of the commanded way, for a robot that responds
constexpr double returned_steps = 4;  // from its place, for a robot that responds again

}  // namespace

bool RespondingRobots::update(const Robots& robots, std::span<const std::uint32_t> counts) {
  bool has_lost = false;
  if (robots.size() != tallies_.size()) {
    has_lost = !aside_.empty();
    forget();
    tallies_.resize(robots.size());
  }
  all_ = &robots;
  all_counts_ = counts;
  for (const Judged& judged : judged_) has_lost |= judge(judged);
  judged_.clear();
  const bool has_won = take_back();
  if (aside_.size() == robots.size()) {  // then all are judged again
    aside_.clear();
    places_.clear();
  }
  if (!aside_.empty()) select();
  return has_lost || has_won;
}

void RespondingRobots::judge_by(std::size_t robot, Vec2 move) {
  const std::size_t i = original(robot);
  judged_.push_back({i, all_->position(i), move});
}

void RespondingRobots::remap(std::span<const std::uint32_t> new_positions) {
  forget();
  if (!new_positions.empty())
    tallies_.resize(*std::ranges::max_element(new_positions) + std::size_t{1});
}

void RespondingRobots::forget() {
  tallies_.clear();
  judged_.clear();
  aside_.clear();
  places_.clear();
}

bool RespondingRobots::judge(const Judged& judged) {
  const auto [robot, from, move] = judged;
  if (robot >= tallies_.size() || move == Vec2{}) return false;
  const double commanded = norm(move);
  const double followed = dot(all_->position(robot) - from, move) / commanded;
  if (followed < least_share * commanded && !map_->is_free(Segment{from, from + move}, 0))
    return false;
  Tally& tally = tallies_[robot];
  tally.commanded += static_cast<float>(commanded);
  tally.followed += static_cast<float>(followed);
  if (tally.commanded < judged_steps * step_) return false;
  const bool responds = tally.followed >= least_share * tally.commanded;
  tally = {};
  const auto at = std::ranges::lower_bound(aside_, robot);
  if (responds || (at != aside_.end() && *at == robot)) return false;
  places_.insert(places_.begin() + (at - aside_.begin()), all_->position(robot));
  aside_.insert(at, robot);
  return true;
}

bool RespondingRobots::take_back() {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < aside_.size(); ++k) {
    if (distance(all_->position(aside_[k]), places_[k]) > returned_steps * step_) continue;
    aside_[kept] = aside_[k];
    places_[kept++] = places_[k];
  }
  const bool returned = kept < aside_.size();
  aside_.resize(kept);
  places_.resize(kept);
  return returned;
}

void RespondingRobots::select() {
  some_.origin = all_->origin;
  some_.x.clear();
  some_.y.clear();
  some_counts_.clear();
  index_.clear();
  auto next = aside_.begin();
  for (std::size_t i = 0; i < all_->size(); ++i) {
    if (next != aside_.end() && *next == i) {
      ++next;
      continue;
    }
    some_.x.push_back(all_->x[i]);
    some_.y.push_back(all_->y[i]);
    if (!all_counts_.empty()) some_counts_.push_back(all_counts_[i]);
    index_.push_back(i);
  }
}

}  // namespace microswarm::navigation
