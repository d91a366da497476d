// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/navigation/following/path_follower.hpp"
#include "microswarm/navigation/following/path_navigator_params.hpp"
#include "microswarm/navigation/steering/steering_cycle.hpp"

namespace microswarm {

/// Path-following navigator; see PathNavigatorParams. States: follow, fallback (pure pursuit
/// instead of the learned follower), hold, arrived, blind.
class PathNavigator : public Navigator {
 public:
  PathNavigator(const PathNavigatorParams& params, const SwarmLimits& swarm, Vec2 goal,
                double goal_tolerance, double frame_timeout = default_frame_timeout);

  void prepare(const Snapshot& world, const Stop& stop) override;
  Command step(const Observation& observation, const Stop& stop) override;
  void overruled(double now, const Command& command) override { steering_.overruled(now, command); }
  NavigatorView view() const override;

 private:
  bool path_is_clear(const Snapshot& world, Pose2 pose) const;

  PathNavigatorParams params_;
  SteeringCycle steering_;
  PathFollower follower_;
  std::vector<Vec2> path_;  ///< including the goal
  PathPlace place_;
};

}  // namespace microswarm
