// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/radar/wait_zone_params.hpp"
#include "microswarm/world/obstacles/body_set.hpp"
#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm::navigation {

/// Position and target of a swarm that may have to wait.
struct Waiting {
  Vec2 position{};    ///< of its centre [µm]
  double radius = 0;  ///< [µm]
  double reach = 0;   ///< distance from the leaves' sweep below which it does not wait [µm]
  Vec2 target{};      ///< [µm]
};

/// Whether the point is in the zone.
bool contains(const WaitZone& area, Vec2 p);

/// Rectangle of the zone.
Polygon zone_outline(const WaitZone& area);

/// Distance [µm] between two bodies; 0 if they touch or overlap.
double gap_between(const Body& a, const Body& b);

/// Eq 29 [radar]: whether some part of the swarm is in the zone and the gap of a valve there, two
/// bodies of one obstacle, is below the minimum. False if the swarm has passed the valve, so that
/// its target is on the same side, or is within reach of the leaves, where it must move on before
/// they close on it.
bool must_wait(const WaitZone& area, std::span<const Body> bodies, const Waiting& swarm);

}  // namespace microswarm::navigation
