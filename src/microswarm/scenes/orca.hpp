// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm::scenes {

/// A disc that avoids others of its kind.
struct OrcaAgent {
  Vec2 position{};       ///< [µm]
  Vec2 velocity{};       ///< [µm/s]
  Vec2 preferred{};      ///< velocity that it would have alone [µm/s]
  double radius = 0;     ///< [µm]
  double max_speed = 0;  ///< [µm/s]
};

/// The velocities of all agents for the next step of `step` seconds: each takes the one nearest to
/// its preferred velocity that avoids the others for `horizon` seconds if they do their half
/// (optimal reciprocal collision avoidance; van den Berg, Guy, Lin and Manocha, "Reciprocal n-Body
/// Collision Avoidance", ISRR 2009). Where there is none, the one that enters the forbidden
/// velocities least.
std::vector<Vec2> orca_velocities(std::span<const OrcaAgent> agents, double horizon, double step);

}  // namespace microswarm::scenes
