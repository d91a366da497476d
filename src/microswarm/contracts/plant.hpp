// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// True state of a plant, if it is known: simulations and recordings know it, rigs do not.
struct GroundTruth {
  double now = 0;  ///< [s]
  SwarmPose swarm{};
  double speed = 0;  ///< [µm/s]
  std::span<const PoseStamped>
      trajectory{};  ///< path of the last apply(), straight between its poses
  std::span<const Vec2>
      robots{};  ///< positions of the robots [µm], if the swarm consists of robots
  const World* world = nullptr;
};

/// System being navigated: a simulated swarm, a simulated or real rig, or a recording.
class Plant {
 public:
  virtual ~Plant() = default;
  /// Newest observation at the plant's current time.
  virtual Observation observe() = 0;
  /// Applies the command for `dt` seconds and advances time by them.
  virtual void apply(const Command& command, double dt) = 0;
  /// Replaces the obstacles from now on; false if unsupported.
  virtual bool set_obstacles(const std::vector<Obstacle>&) { return false; }
  /// Reason why it cannot continue; empty while it can. Valid until the next observe().
  virtual std::string_view fault() const { return {}; }
  /// Valid until the next apply(); empty if unknown.
  virtual std::optional<GroundTruth> ground_truth() const { return std::nullopt; }
};

}  // namespace microswarm
