// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/navigation/following/follower.hpp"
#include "microswarm/navigation/steering/delay_compensator.hpp"
#include "microswarm/swarm/body/ribbon.hpp"

namespace microswarm::learning {

/// The expert imitated by a learned follower: a preview controller with access to the ground truth
/// of pose, flow and speed. At every tick it simulates pure pursuits with several lookaheads and
/// speeds, each corrected for the flow. Their cost combines the distance from the path, slowness
/// and turning. The command is the mean over all, weighted towards low cost, and so a smooth
/// function of the pose.
class FollowerExpert {
 public:
  /// `speed` is the commanded speed [µm/s].
  FollowerExpert(const RibbonParams& swarm, std::span<const Vec2> path, double speed);

  /// Command at time `now` [s] for a swarm at `pose`.
  Command command(const Pose2& pose, double now);
  /// Records the command given at that time, by the expert or another navigator.
  void note(double now, const Command& command);

 private:
  struct Trial {
    Command first;
    double cost = 0;
  };
  Trial play(Pose2 pose, navigation::PathPosition position, double lookahead, double share) const;
  Pose2 moved(const Pose2& pose, const Command& command) const;

  RibbonParams swarm_;
  std::span<const Vec2> path_;
  double speed_;
  navigation::DelayCompensator compensator_;  ///< of the swarm's true response to commands
  navigation::PathPosition position_;
  Command last_;
};

}  // namespace microswarm::learning
