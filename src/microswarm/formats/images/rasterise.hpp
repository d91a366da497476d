// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::formats {

/// Cells of side `cell` [µm] over the map's bounds, from the lower left corner, whose centre is not
/// free: in or on a wall, or outside if the bounds are not a whole number of cells. Inverse of
/// mask_walls for the same cell. Throws InputError for more cells than an image may have pixels.
Mask rasterise(const Map& map, double cell);

/// Mask of the cells whose position, `cell_position(column, row)`, is in or on a wall or outside
/// the map.
template <class PlaceOf>
Mask blocked_cells(const Map& map, int width, int height, PlaceOf&& cell_position) {
  Mask mask(width, height);
  std::vector<Vec2> positions(static_cast<std::size_t>(width));
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column)
      positions[static_cast<std::size_t>(column)] = cell_position(column, row);
    const std::span cells(&mask.at(0, row), positions.size());
    map.are_free(positions, 0, cells);
    for (std::uint8_t& cell : cells) cell = cell == 0;
  }
  return mask;
}

}  // namespace microswarm::formats
