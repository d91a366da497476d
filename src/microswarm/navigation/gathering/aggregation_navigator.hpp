// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_policy.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_policy.hpp"
#include "microswarm/navigation/steering/robot_steering_navigator.hpp"

namespace microswarm::navigation {

/// Reports an empty list of the lengths by which a rollout changes a plan.
Issues validate(const AggregationParams& params);

/// Navigator of HRA and DCA, Alg 3 and 5 [gather], and of the rollout planner. It predicts the
/// robots' positions when its command takes effect and commands the policy's move, limited to what
/// a tick allows. States: gather, arrived, blind.
class AggregationNavigator : public RobotSteeringNavigator {
 public:
  using Params = AggregationParams;
  static std::string_view unsupported_reason(const Task& task);

  /// It gathers until the mean path length to the goal is below the goal tolerance, by the tree's
  /// paths, and more closely down to half of it, where the task
  /// continues after that.
  AggregationNavigator(const AggregationParams& params, const Task& task, Rng rng);

  /// Grows the tree. Throws InputError as AggregationMap does.
  void prepare(const Snapshot& world, const Stop& stop) override;
  Diagnostics diagnostics() const override;
  /// The policy; null before prepare().
  const AggregationPolicy* policy() const { return policy_ ? &*policy_ : nullptr; }
  /// The map data; null before prepare().
  const AggregationMap* map() const { return map_ ? &*map_ : nullptr; }

 private:
  Decision decide(const Robots& robots, double now, const Stop& stop) override;
  void begin();

  AggregationParams params_;
  Vec2 goal_;
  Rng rng_;
  int ticks_gathered_ = 0;
  std::optional<AggregationMap> map_;
  std::optional<AggregationPolicy> policy_;
  std::optional<RolloutPolicy> rollout_;
};

}  // namespace microswarm::navigation
