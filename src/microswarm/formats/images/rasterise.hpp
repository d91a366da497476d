// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Cells of side `cell` [µm] over the map's bounds, from the lower left corner, whose centre is not
/// free: in or on a wall, or outside if the bounds are not a whole number of cells. Inverse of
/// mask_walls for the same cell. Throws InputError for more cells than an image may have pixels.
Mask rasterise(const Map& map, double cell);

}  // namespace microswarm
