// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// The swarm as one body: centre, heading, radius [µm].
struct SwarmPose {
  Pose2 pose;
  double radius = 0;
};

/// Where a swarm was, how wide [µm], and when [s].
struct PoseStamped {
  double t = 0;
  Pose2 pose;
  double radius = 0;
};

/// Age of a frame [s] from which on a navigator holds, where nothing else is said.
inline constexpr double default_frame_timeout = 0.5;

/// What is seen: the newest frame, which is `age()` old when the navigator gets it. `swarm` is
/// empty when no swarm was found in the frame. `robots` are its robots one by one, where they are
/// told apart: robot i is the same in every observation; `swarm` is then their middle. `world`
/// holds the map and the obstacles as seen then. `robots` lives at least until the next
/// observation; who keeps the world shares it.
struct Observation {
  double now = 0;   ///< time at which the navigator is asked [s]
  double seen = 0;  ///< time at which the frame was taken [s]
  std::optional<SwarmPose> swarm;
  std::span<const Vec2> robots;  ///< [µm]
  std::shared_ptr<const Snapshot> world;

  double age() const { return now - seen; }
};

/// A world that is not owned, for an Observation that it outlives.
inline std::shared_ptr<const Snapshot> borrowed(const Snapshot& world) {
  return {std::shared_ptr<const Snapshot>(), &world};
}

}  // namespace microswarm
