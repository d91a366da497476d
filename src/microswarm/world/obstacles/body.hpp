// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// One solid at one moment: a connected wall piece or a moving obstacle. It has no velocity, since
/// a frame does not show one; ObstacleTracker estimates velocities.
struct Body {
  std::variant<Disc, Polygon> shape{};
  std::uint32_t obstacle =
      0;  ///< number of the wall piece or obstacle; both leaves of a valve share it
};

/// Returns whether the body is a disc.
bool is_disc(const Body& body);
/// The outer ring of a polygon; null for a disc.
const std::vector<Vec2>* find_outline(const Body& body);

/// Distances [µm] between closed sets; 0 when they share a point.
double distance(Vec2 p, const Body& body);
double distance(Segment s, const Body& body);

/// Centre of a body, the disc's or the centroid of the outline, and its radius around it [µm].
Disc enclosing_disc(const Body& body);

/// Moves the body by `by` [µm].
void shift(Body& body, Vec2 by);

}  // namespace microswarm
