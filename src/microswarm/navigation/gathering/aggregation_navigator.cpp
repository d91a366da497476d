// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/aggregation_navigator.hpp"

#include <algorithm>

#include "microswarm/navigation/gathering/policies/published_scale.hpp"

namespace microswarm::navigation {

Issues validate(const AggregationParams& params) {
  Issues issues;
  if (params.rollout.tuning.change_lengths.empty())
    issues.add("rollout.tuning.change_lengths",
               "rollout.tuning.change_lengths is empty, must have a value");
  return issues;
}

std::string_view AggregationNavigator::unsupported_reason(const Task& task) {
  if (!task.robots) return "robots";
  if (task.robots->contact != ContactRule::stop) return "robots that stop at walls";
  return task.goal ? "" : "one goal for all robots";
}

AggregationNavigator::AggregationNavigator(const AggregationParams& params, const Task& task,
                                           Rng rng)
    : RobotSteeringNavigator(task), params_(params), goal_(*task.goal), rng_(rng) {}

void AggregationNavigator::prepare(const Snapshot& world, const Stop& stop) {
  params_ = fitted(params_, world.map(), rng_);
  params_.sigma = std::min(params_.sigma, goal_tolerance());
  params_.step = std::min(params_.step, max_move());
  map_.emplace(world.map(), goal_, params_, rng_, MoveRule::any_direction, stop);
  if (map_->was_stopped) {
    map_.reset();
    return;
  }
  RobotSteeringNavigator::prepare(world, stop);
  begin();
}

void AggregationNavigator::begin() {
  policy_.emplace(*map_, params_);
  if (params_.method == Aggregation::rollout) rollout_.emplace(*map_, stepper(), params_, rng_);
}

Decision AggregationNavigator::decide(const Robots& robots, double, const Stop& stop) {
  const std::optional<Vec2> displacement =
      rollout_ ? rollout_->next(robots, stop) : policy_->next(robots);
  if (!displacement) {
    constexpr int patience = 20;    // ticks in which the task should have seen it
    constexpr double closer = 0.8;  // of the distance at which the task continues
    constexpr double least = 0.5;   // of the tolerance
    if (++ticks_gathered_ > patience && params_.sigma > least * goal_tolerance()) {
      ticks_gathered_ = 0;
      params_.sigma = std::max(closer * params_.sigma, least * goal_tolerance());
      begin();
    }
    return hold(NavigatorState::arrived);
  }
  ticks_gathered_ = 0;
  if (!rollout_) step_view().local_target = policy_->waypoint();
  return move(*displacement, NavigatorState::gather);
}

Diagnostics AggregationNavigator::diagnostics() const {
  if (!policy_) return {};
  AggregationDiagnostics out;
  out.mean_distance = rollout_ ? rollout_->mean_distance() : policy_->mean_distance();
  out.is_livelock = (rollout_ ? rollout_->guard_count() : policy_->guard_count()) > 0;
  if (rollout_) {
    out.moves_left = static_cast<std::uint32_t>(rollout_->steps_left());
  } else if (policy_->leader() != AggregationPolicy::no_leader) {
    out.leader = static_cast<std::uint32_t>(policy_->leader());
    if (params_.method == Aggregation::divide_and_conquer) {
      out.team_region = policy_->division().region();
      out.team_branch = policy_->division().branch();
    }
  }
  const planning::MapSegmentation& segmentation = map_->segmentation;
  for (std::size_t i = 0; i < segmentation.region.size(); ++i)
    out.nodes.push_back({map_->tree.nodes[i], map_->routes().next[i], segmentation.region[i],
                         segmentation.branch[i]});
  out.regions = segmentation.regions;
  return out;
}

}  // namespace microswarm::navigation
