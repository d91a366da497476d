// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// The swarm as one body: pose and radius [µm].
struct SwarmPose {
  Pose2 pose{};
  double radius = 0;
};

/// Pose and radius [µm] of a swarm at a time [s].
struct PoseStamped {
  double t = 0;
  Pose2 pose{};
  double radius = 0;
};

/// Default age of a frame [s] from which a navigator holds.
inline constexpr double default_frame_timeout = 0.5;

/// Newest frame available to the navigator, `age()` old. `swarm` is empty if no swarm was found in
/// the frame. `robots` are the positions of individually tracked robots, empty otherwise; robot i
/// is the same in every observation, and `swarm` is then their centre. `world` holds the map and
/// the obstacles as seen in the frame. `robots` is valid until the next observation; `world` is
/// shared.
struct Observation {
  double now = 0;   ///< current time [s]
  double seen = 0;  ///< capture time of the frame [s]
  std::optional<SwarmPose> swarm{};
  std::span<const Vec2> robots{};  ///< [µm]
  int unseen = 0;                  ///< number of robots not detected, at expected positions
  std::shared_ptr<const Snapshot> world{};

  /// Age of the frame [s].
  double age() const { return now - seen; }
};

/// Non-owning pointer to what outlives its user, for example a world that outlives an Observation.
template <class T>
std::shared_ptr<T> borrowed(T& object) {
  return {std::shared_ptr<T>(), &object};
}

}  // namespace microswarm
