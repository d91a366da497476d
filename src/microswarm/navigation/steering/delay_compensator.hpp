// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"
#include "microswarm/swarm/body/unicycle.hpp"

namespace microswarm {

/// Keeps the commands given to a swarm of one body and tells where they take it: a frame is old
/// when it is seen, and a command takes effect only after the swarm's dead time. Allocates nothing
/// after it is made.
class DelayCompensator {
 public:
  explicit DelayCompensator(const SwarmLimits& swarm)
      : turn_rate_(swarm.max_turn_rate), lag_(swarm.response_lag) {
    issued_.reserve(max_commands);
  }

  /// Notes a command that is given at the time `now` [s].
  void note(double now, const Command& command) {
    if (issued_.size() == max_commands) issued_.erase(issued_.begin(), issued_.begin() + 128);
    issued_.push_back({now, command});
  }

  /// Where a swarm that was seen will be when a command given now takes effect. Forgets the
  /// commands that were over by the time of the frame.
  Pose2 at_effect(const Observation& seen) {
    const auto in_effect = std::find_if(issued_.begin() + (issued_.empty() ? 0 : 1), issued_.end(),
                                        [&](const Issued& i) { return starts(i) > seen.seen; });
    if (in_effect - issued_.begin() > 1) issued_.erase(issued_.begin(), in_effect - 1);
    return moved(seen.swarm->pose, seen.seen, seen.now + lag_);
  }

  /// Where the commands take a swarm from its pose at the time `t` to the time `until` [s]. Those
  /// before the newest frame that was asked about are forgotten.
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

}  // namespace microswarm
