// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/watch/fault.hpp"
#include "microswarm/rig/watch/follow_monitor.hpp"
#include "microswarm/rig/watch/rig_watch.hpp"

namespace microswarm::rig {

/// Checks SafetyParams on what the pictures show: their age, a lost swarm, a swarm that does not
/// follow its commands, and all that RigWatch sees. A rig in real time and a simulated one end by
/// the same checks.
class SightMonitor {
 public:
  /// `delay`: from a command to the motion that it causes [s].
  SightMonitor(const SafetyParams& params, double delay)
      : params_(params),
        following_(params.min_follow_share, params.max_follow_share),
        watch_(params, delay) {}

  /// Takes a grey picture of the time `seen` [s] and the detections in it. `follow_distance`:
  /// commanded distance over which following is judged, unless the parameters name one [µm].
  void take(const formats::Image& picture, const Detections& detections, const CameraView& view,
            double seen, double follow_distance);

  /// Why a run cannot continue at `now` [s]; no reason if it can.
  Fault fault(double now) const;
  /// Time at which the newest picture was taken [s]; 0 before the first.
  double seen() const { return seen_; }
  /// Whether the swarm did not follow its commands, or went farther.
  bool lost_following() const { return !does_not_follow_.empty(); }
  RigWatch& watch() { return watch_; }
  const RigWatch& watch() const { return watch_; }
  /// Direction of the swarm relative to its commands, if it is known.
  std::optional<FollowDirection> direction() const { return angle_.direction(); }

 private:
  SafetyParams params_;
  FollowMonitor following_;
  FollowAngle angle_;
  RigWatch watch_;
  double seen_ = 0;            // time of the newest picture [s]
  double found_ = 0;           // time of the newest one that shows the swarm [s]
  std::string why_not_found_;  // in the newest picture
  std::string does_not_follow_;
};

}  // namespace microswarm::rig
