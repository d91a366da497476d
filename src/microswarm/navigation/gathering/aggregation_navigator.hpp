// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_policy.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_policy.hpp"
#include "microswarm/navigation/steering/robot_steering_cycle.hpp"

namespace microswarm {

/// Reports an empty list of the lengths by which a rollout changes a plan.
Issues validate(const AggregationParams& params);

/// Navigator of HRA and DCA, Alg 3 and 5 [gather], and of the rollout planner. It predicts the
/// robots' positions when its command takes effect and commands the policy's move, limited to what
/// a tick allows. States: gather, arrived, blind.
class AggregationNavigator : public Navigator {
 public:
  /// `robots`: their known properties; `tick` [s] between two commands. It continues until the mean
  /// path length to the goal is at most half of `goal_tolerance` [µm], independent of the task's
  /// measure.
  AggregationNavigator(const AggregationParams& params, const RobotSwarmParams& robots, Vec2 goal,
                       double goal_tolerance, double tick, Rng rng,
                       double frame_timeout = default_frame_timeout);

  /// Grows the tree. Throws InputError as AggregationMap does.
  void prepare(const Snapshot& world, const Stop& stop) override;
  Command step(const Observation& observation, const Stop& stop) override;
  void overruled(double now, const Command& command) override { steering_.overruled(now, command); }
  NavigatorView view() const override { return steering_.view(); }
  Diagnostics diagnostics() const override;
  /// The policy; null before prepare().
  const AggregationPolicy* policy() const { return policy_ ? &*policy_ : nullptr; }
  /// The map data; null before prepare().
  const AggregationMap* map() const { return map_ ? &*map_ : nullptr; }

 private:
  AggregationParams params_;
  Vec2 goal_;
  double goal_tolerance_;
  Rng rng_;
  RobotSteeringCycle steering_;
  std::optional<AggregationMap> map_;
  std::optional<AggregationPolicy> policy_;
  std::optional<RolloutPolicy> rollout_;
};

}  // namespace microswarm
