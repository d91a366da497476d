// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// The cells of side `cell` [µm] over the map's bounds, from the lower left corner, whose centre is
/// not free: in or on a wall, or outside where the bounds are no whole number of cells. The inverse
/// of mask_walls for the same cell. Throws InputError for more cells than an image may have pixels.
Mask rasterise(const Map& map, double cell);

}  // namespace microswarm
