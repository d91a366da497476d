// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::vision {

/// Closed chains of vertices that touch neither themselves nor each other.
using Rings = std::vector<std::vector<Vec2>>;

/// Whether two rings touch, or one touches itself. Exact. `cell` [µm] is the size of the search
/// buckets, about the length of an edge.
bool touch(const Rings& rings, double cell);

/// Smooths rings whose vertices are about `cell` apart (Gaussian along the ring). No vertex moves
/// by more than `limit` [µm]; a vertex whose move would make rings touch stays in place.
void smooth_rings(Rings& rings, double cell, double limit);

/// Removes vertices, least significant first. Every removed vertex stays within `tolerance` [µm] of
/// the new edge, rings never touch, and none passes over another. `stop` leaves more vertices.
void thin_rings(Rings& rings, double cell, double tolerance, const Stop& stop = {});

}  // namespace microswarm::vision
