// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// The swarm as one body: centre, heading, radius [µm].
struct SwarmPose {
  Pose2 pose;
  double radius = 0;
};

/// A pose and when it was taken [s].
struct TimedPose {
  double t = 0;
  Pose2 pose;
};

/// What is seen: the newest frame, which is `age()` old when the navigator gets it. `swarm` is
/// empty when no swarm was found in the frame. `world` holds the map and the obstacles as seen
/// then; it lives at least until the next observation.
struct Observation {
  double now = 0;   ///< time at which the navigator is asked [s]
  double seen = 0;  ///< time at which the frame was taken [s]
  std::optional<SwarmPose> swarm;
  const Snapshot* world = nullptr;

  double age() const { return now - seen; }
};

/// One global input: where to head [rad] and how fast [µm/s]. Speed 0 is hold.
struct Command {
  double heading = 0;
  double speed = 0;
};

/// What really is, where a plant can tell: simulations and recordings know it, rigs do not.
struct Truth {
  double now = 0;  ///< [s]
  SwarmPose swarm;
  double speed = 0;                  ///< [µm/s]
  std::span<const TimedPose> swept;  ///< the way of the last apply(), straight between its poses
  const World* world = nullptr;
};

/// Something that is navigated: a simulated swarm, a simulated or real rig, a recording.
class Plant {
 public:
  virtual ~Plant() = default;
  /// The newest observation at the plant's present time.
  virtual Observation observe() = 0;
  /// Applies the command for `dt` seconds and lets them pass.
  virtual void apply(const Command& command, double dt) = 0;
  /// Valid until the next apply(); empty when nobody knows.
  virtual std::optional<Truth> truth() const { return std::nullopt; }
};

}  // namespace microswarm
