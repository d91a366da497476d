// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Free position with clearance `r` > 0 [µm] near a detected position: `position` itself if it is
/// free, else the first free point found in 16 directions at distances that grow by a factor of
/// 1.25. Returns `position` if none is found.
Vec2 free_place(const Map& map, Vec2 position, double r);

}  // namespace microswarm
