// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// The swarm as one body: centre, heading, radius [µm].
struct SwarmPose {
  Pose2 pose;
  double radius = 0;
};

/// Where a swarm was, how wide [µm], and when [s].
struct TimedPose {
  double t = 0;
  Pose2 pose;
  double radius = 0;
};

/// What is seen: the newest frame, which is `age()` old when the navigator gets it. `swarm` is
/// empty when no swarm was found in the frame. `robots` are its robots one by one, where they are
/// told apart: robot i is the same in every observation; `swarm` is then their middle. `world`
/// holds the map and the obstacles as seen then. Both live at least until the next observation.
struct Observation {
  double now = 0;   ///< time at which the navigator is asked [s]
  double seen = 0;  ///< time at which the frame was taken [s]
  std::optional<SwarmPose> swarm;
  std::span<const Vec2> robots;  ///< [µm]
  const Snapshot* world = nullptr;

  double age() const { return now - seen; }
};

/// One global input: where to head [rad] and how fast [µm/s]. Speed 0 is hold.
struct Command {
  double heading = 0;
  double speed = 0;
};

/// The way [µm] that a command asks for in `dt` seconds; along an axis exactly.
inline Vec2 displacement(const Command& command, double dt) {
  constexpr double rounding = 1e-15;
  const Vec2 u = unit_vector(command.heading);
  const double length = command.speed * dt;
  return {std::abs(u.x) < rounding ? 0 : length * u.x, std::abs(u.y) < rounding ? 0 : length * u.y};
}

/// The command that asks for the way `move` [µm] in `dt` seconds.
inline Command command_for(Vec2 move, double dt) { return {heading_of(move), norm(move) / dt}; }

/// What really is, where a plant can tell: simulations and recordings know it, rigs do not.
struct Truth {
  double now = 0;  ///< [s]
  SwarmPose swarm;
  double speed = 0;                  ///< [µm/s]
  std::span<const TimedPose> swept;  ///< the way of the last apply(), straight between its poses
  std::span<const Vec2> robots;      ///< one by one [µm], of a swarm that consists of robots
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
  /// Why it cannot go on, in words; empty while it can. Valid until the next observe().
  virtual std::string_view fault() const { return {}; }
  /// Valid until the next apply(); empty when nobody knows.
  virtual std::optional<Truth> truth() const { return std::nullopt; }
};

}  // namespace microswarm
