// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/aggregation_policy.hpp"

#include <algorithm>

namespace microswarm::navigation {
namespace {

/// Steps without progress that are allowed: those of so many longest paths.
double allowed_steps(const AggregationMap& map, const AggregationParams& params) {
  return params.patience * std::max(map.longest / params.step, 1.0);
}

}  // namespace

AggregationPolicy::AggregationPolicy(const AggregationMap& map, const AggregationParams& params)
    : map_(&map),
      params_(params),
      responding_(map.map, params.step),
      distances_(map),
      dca_(map, params),
      guard_(allowed_steps(map, params), params.sigma),
      follower_(map, params.step) {
  if (params.method == Aggregation::dynamic_shortest_path)
    chase_.emplace(map, params.step, allowed_steps(map, params));
}

std::optional<Vec2> AggregationPolicy::next(const Robots& all,
                                            std::span<const std::uint32_t> all_counts) {
  if (responding_.update(all, all_counts)) restart(all, all_counts);
  const Robots& robots = responding_.robots();
  distances_.update(robots, responding_.counts());
  if (all.size() == 0 || distance_left() < params_.sigma) return std::nullopt;
  const RobotsOnMap& on_map = distances_.robots();
  chases_ = chase_ && chase_->chases(robots, on_map);
  if (chases_) {
    const Vec2 move = lead(chase_->follower(), chase_->move(robots));
    responding_.judge_by(chase_->target(), move);
    return move;
  }
  const bool guarded = guard_.update(distance_left());
  if (guarded || is_livelock())
    leader_ = random_leader(on_map, leader_, params_.step, rng_);
  else if (params_.method == Aggregation::heuristic || chase_)
    leader_ = heuristic_leader(on_map, leader_, params_.step);
  else
    leader_ = dca_.leader(on_map, leader_);
  return lead(leader_, follower_.move(leader_, robots.size(), robots.position(leader_)));
}

Vec2 AggregationPolicy::lead(std::size_t robot, Vec2 move) {
  leader_ = robot;
  responding_.judge_by(robot, move);
  return move;
}

// Others respond now, with other indices. What was found of a livelock stays.
void AggregationPolicy::restart(const Robots& all, std::span<const std::uint32_t> counts) {
  leader_ = no_leader;
  dca_ = DivideAndConquer(*map_, params_);
  follower_ = WaypointFollower(*map_, params_.step);
  distances_ = SwarmDistances(*map_);
  if (chase_ && !chase_->gave_up())
    chase_.emplace(*map_, params_.step, allowed_steps(*map_, params_));
  aside_count_ = aside_sum_ = aside_max_ = 0;
  for (const std::size_t i : responding_.aside()) {
    const Vec2 p = all.position(i);
    const double length = map_->length_from(p, map_->tree.nearest(p));
    const double count = counts.empty() ? 1 : counts[i];
    aside_count_ += count;
    aside_sum_ += count * length;
    aside_max_ = std::max(aside_max_, length);
  }
}

double AggregationPolicy::left(Gathered measure) const {
  const double left = distances_.left(measure);
  if (aside_count_ == 0) return left;
  if (measure == Gathered::all) return std::max(left, aside_max_);
  return (distances_.count() * left + aside_sum_) / (distances_.count() + aside_count_);
}

void AggregationPolicy::remap(std::span<const std::uint32_t> new_positions) {
  if (!distances_.remap(new_positions)) return;
  responding_.remap(new_positions);
  follower_.remap(new_positions);
  if (chase_) chase_->remap(new_positions);
  if (leader_ < new_positions.size()) leader_ = new_positions[leader_];
}

}  // namespace microswarm::navigation
