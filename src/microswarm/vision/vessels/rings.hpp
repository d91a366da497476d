// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Closed chains of vertices, none of which touches itself or another.
using Rings = std::vector<std::vector<Vec2>>;

/// Do two rings touch, or one itself? Exact. `cell` [µm] is the size of the buckets it searches,
/// about the length of an edge.
bool touch(const Rings& rings, double cell);

/// Smooths rings of vertices about `cell` apart (Gaussian along the ring); no vertex moves by more
/// than `limit` [µm], and one whose move would make rings touch stays where it is.
void smooth_rings(Rings& rings, double cell, double limit);

/// Leaves out vertices, those first that matter least, as long as every vertex left out is within
/// `tolerance` [µm] of the new edge over it, the rings do not touch, and none passes over another.
void thin_rings(Rings& rings, double cell, double tolerance);

}  // namespace microswarm
