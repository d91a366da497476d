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
    : params_(params),
      distances_(map),
      dca_(map, params),
      guard_(allowed_steps(map, params), params.sigma),
      follower_(map, params.step) {
  if (params.method == Aggregation::dynamic_shortest_path)
    chase_.emplace(map, params.step, allowed_steps(map, params));
}

std::optional<Vec2> AggregationPolicy::next(const Robots& robots,
                                            std::span<const std::uint32_t> counts) {
  distances_.update(robots, counts);
  if (robots.size() == 0 || distance_left() < params_.sigma) return std::nullopt;
  const RobotsOnMap& on_map = distances_.robots();
  chases_ = chase_ && chase_->chases(robots, on_map);
  if (chases_) {
    leader_ = chase_->follower();
    return chase_->move(robots);
  }
  const bool guarded = guard_.update(distance_left());
  if (guarded || is_livelock())
    leader_ = random_leader(on_map, leader_, params_.step, rng_);
  else if (params_.method == Aggregation::heuristic || chase_)
    leader_ = heuristic_leader(on_map, leader_, params_.step);
  else
    leader_ = dca_.leader(on_map, leader_);
  return follower_.move(leader_, robots.size(), robots.position(leader_));
}

void AggregationPolicy::remap(std::span<const std::uint32_t> new_positions) {
  if (!distances_.remap(new_positions)) return;
  follower_.remap(new_positions);
  if (chase_) chase_->remap(new_positions);
  if (leader_ < new_positions.size()) leader_ = new_positions[leader_];
}

}  // namespace microswarm::navigation
