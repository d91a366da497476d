// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/navigation/following/follower.hpp"
#include "microswarm/navigation/steering/delay_compensator.hpp"
#include "microswarm/swarm/body/ribbon.hpp"

namespace microswarm {

/// The expert that a learned follower imitates: a preview controller that knows what no camera
/// shows, namely where the swarm really is, the flow and its real speed. At every tick it plays
/// pure pursuits of several lookaheads and speeds through the seconds to come, each crabbing in the
/// flow, and weighs them by how far they come off the path, how slow they are and how much they
/// turn. What it commands is the mean over all, the best ones counting most, so that it is a smooth
/// function of where the swarm is.
class FollowerExpert {
 public:
  /// `speed` [µm/s] is that asked for.
  FollowerExpert(const RibbonParams& swarm, std::span<const Vec2> path, double speed);

  /// What to command at the time `now` [s] to a swarm that is at `pose` then.
  Command command(const Pose2& pose, double now);
  /// Notes what was commanded at that time, whoever chose it.
  void note(double now, const Command& command);

 private:
  struct Way {
    Command first;
    double cost = 0;
  };
  Way play(Pose2 pose, PathPlace place, double lookahead, double share) const;
  Pose2 moved(const Pose2& pose, const Command& command) const;

  RibbonParams swarm_;
  std::span<const Vec2> path_;
  double speed_;
  DelayCompensator compensator_;  ///< of the commands as the swarm really obeys them
  PathPlace place_;
  Command last_;
};

}  // namespace microswarm
