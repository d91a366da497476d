// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/baselines/straight_params.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"

namespace microswarm::navigation {

/// Straight-line baseline; see StraightParams. It does not stop for what is near but gets no nearer
/// ahead. States: follow, hold, arrived, blind.
class StraightNavigator : public SteeringNavigator {
 public:
  using Params = StraightParams;
  StraightNavigator(const StraightParams& params, const Task& task, Rng)
      : SteeringNavigator(task, params.speed), params_(params) {}

  void prepare(const Snapshot& world, const Stop& stop) override;

 private:
  Decision decide(const Moment& moment) override;
  bool path_is_clear(const Snapshot& world, Pose2 pose) const;

  StraightParams params_;
};

}  // namespace microswarm::navigation
