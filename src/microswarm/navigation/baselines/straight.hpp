// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/navigation/baselines/straight_params.hpp"
#include "microswarm/navigation/steering/steering_cycle.hpp"

namespace microswarm {

/// Straight-line baseline; see StraightParams. It does not stop for what is near but gets no nearer
/// ahead. States: follow, hold, arrived, blind.
class StraightNavigator : public Navigator {
 public:
  StraightNavigator(const StraightParams& params, const SwarmLimits& swarm, Vec2 goal,
                    double goal_tolerance, double frame_timeout = default_frame_timeout)
      : params_(params), steering_(swarm, params.speed, goal, goal_tolerance, frame_timeout) {}

  void prepare(const Snapshot& world, const Stop& stop) override;
  Command step(const Observation& observation, const Stop& stop) override;
  void overruled(double now, const Command& command) override { steering_.overruled(now, command); }
  NavigatorView view() const override { return steering_.view(); }

 private:
  bool path_is_clear(const Snapshot& world, Pose2 pose) const;

  StraightParams params_;
  SteeringCycle steering_;
};

}  // namespace microswarm
