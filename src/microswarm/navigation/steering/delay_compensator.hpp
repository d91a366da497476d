// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"
#include "microswarm/swarm/body/unicycle.hpp"

namespace microswarm::navigation {

/// Predicts a single-body swarm from its past commands: a frame is already old when it arrives, and
/// a command takes effect only after the swarm's dead time. Does not allocate after construction.
class DelayCompensator {
 public:
  explicit DelayCompensator(const SwarmLimits& swarm)
      : turn_rate_(swarm.max_turn_rate), lag_(swarm.response_lag) {
    issued_.reserve(max_commands);
  }

  /// Records a command given at the time `now` [s].
  void note(double now, const Command& command) {
    if (issued_.size() == max_commands) issued_.erase(issued_.begin(), issued_.begin() + 128);
    issued_.push_back({now, command});
  }

  /// Pose of an observed swarm when a command given now takes effect. Drops the commands that had
  /// ended by the time of the frame.
  Pose2 at_effect(const Observation& seen) {
    const auto in_effect = std::find_if(issued_.begin() + (issued_.empty() ? 0 : 1), issued_.end(),
                                        [&](const Issued& i) { return starts(i) > seen.seen; });
    if (in_effect - issued_.begin() > 1) issued_.erase(issued_.begin(), in_effect - 1);
    return moved(seen.swarm->pose, seen.seen, seen.now + lag_);
  }

  /// Pose to which the commands take a swarm from its pose at the time `t` until the time `until`
  /// [s]. Commands before the newest frame passed to at_effect are dropped.
  Pose2 moved(Pose2 pose, double t, double until) const {
    for (std::size_t i = 0; i < issued_.size() && t < until; ++i) {
      const double end = i + 1 < issued_.size() ? std::min(until, starts(issued_[i + 1])) : until;
      if (end <= t || starts(issued_[i]) > t + same_moment) continue;
      pose = unicycle_step(pose, issued_[i].command, turn_rate_, end - t);
      t = end;
    }
    return pose;
  }

 private:
  static constexpr std::size_t max_commands = 256;
  static constexpr double same_moment = 1e-9;  // [s]
  struct Issued {
    double time;
    Command command;
  };
  double starts(const Issued& i) const { return i.time + lag_; }

  double turn_rate_;
  double lag_;
  std::vector<Issued> issued_;
};

}  // namespace microswarm::navigation
