// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/navigation/gathering/aggregation_policy.hpp"
#include "microswarm/navigation/gathering/rollout_policy.hpp"
#include "microswarm/navigation/steering/robot_steering_cycle.hpp"

namespace microswarm {

/// HRA and DCA, Alg 3 and 5 [gather], and the rollout planner as a navigator: looks at where the
/// robots will be when its command takes effect, and gives the policy's move, or as much of it as
/// a tick allows. States: gather, arrived, blind.
class AggregationNavigator : public Navigator {
 public:
  /// `robots`: what is known of them; `tick` [s] between two commands. It goes on until the mean
  /// way is at most half of the task's `goal_tolerance` [µm], however that is measured there.
  AggregationNavigator(const AggregationParams& params, const RobotSwarmParams& robots, Vec2 goal,
                       double goal_tolerance, double tick, Rng rng,
                       double frame_timeout = default_frame_timeout);

  /// Grows the tree. Throws InputError as AggregationMap does.
  void prepare(const Snapshot& world) override;
  Command step(const Observation& observation, const Stop& stop) override;
  NavigatorView view() const override { return steering_.view(); }
  /// After prepare(): null before.
  const AggregationPolicy* policy() const { return policy_ ? &*policy_ : nullptr; }
  /// What it gathers by; null before prepare().
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
