// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/radar/wait_zone_params.hpp"
#include "microswarm/world/obstacles/body_set.hpp"
#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm {

/// Where a swarm is that may have to wait, and where it is going.
struct Waiting {
  Vec2 position;      ///< of its centre [µm]
  double radius = 0;  ///< [µm]
  double reach = 0;   ///< nearer to the leaves' way than this it does not wait [µm]
  Vec2 target;        ///< [µm]
};

/// Is the point in the area?
bool contains(const WaitZone& area, Vec2 p);

/// Its rectangle.
Polygon outline_of(const WaitZone& area);

/// Distance [µm] between two bodies, 0 when they touch or overlap.
double gap_between(const Body& a, const Body& b);

/// Eq 29 [radar]: is some part of the swarm in the area, and the gap of a valve there, two bodies
/// of one obstacle, below the least? Not so when the swarm has passed the valve, its target being
/// on the same side, nor when it is within reach of the leaves: there it must go on or get out,
/// lest they close on it.
bool must_wait(const WaitZone& area, std::span<const Body> bodies, const Waiting& swarm);

}  // namespace microswarm
