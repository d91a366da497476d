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

/// What really is, where a plant can tell: simulations and recordings know it, rigs do not.
struct GroundTruth {
  double now = 0;  ///< [s]
  SwarmPose swarm;
  double speed = 0;  ///< [µm/s]
  std::span<const PoseStamped>
      trajectory;                ///< the way of the last apply(), straight between its poses
  std::span<const Vec2> robots;  ///< one by one [µm], of a swarm that consists of robots
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
  /// Has these obstacles from now on; false where it cannot.
  virtual bool set_obstacles(const std::vector<Obstacle>&) { return false; }
  /// Why it cannot go on, in words; empty while it can. Valid until the next observe().
  virtual std::string_view fault() const { return {}; }
  /// Valid until the next apply(); empty when nobody knows.
  virtual std::optional<GroundTruth> ground_truth() const { return std::nullopt; }
};

}  // namespace microswarm
