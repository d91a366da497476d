// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm::formats {

/// Set of square cells: 1 = set, 0 = not; row by row, y down.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cells{};  ///< width · height

  Mask() = default;
  Mask(int w, int h)
      : width(w), height(h), cells(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::uint8_t& at(int column, int row) { return cells[index(column, row)]; }
  std::uint8_t at(int column, int row) const { return cells[index(column, row)]; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
  friend bool operator==(const Mask&, const Mask&) = default;
};

/// Mask of the cells whose grey value (luma of colours) is below `level` if `dark_is_set`, else of
/// those at or above it. The two masks are complements.
Mask threshold(const Image& image, int level, bool dark_is_set);

/// Box covered by the cells. `cell` [µm] is their side, `lo` the lower left corner in the world.
Box cell_bounds(const Mask& mask, double cell, Vec2 lo = {});

/// World centre [µm] of a cell; converts image to world coordinates. In files columns go right and
/// rows down; in the world x goes right and y up. Cell (column, row) covers lo + [column, column +
/// 1] · cell × [height − row − 1, height − row] · cell.
Vec2 cell_centre(const Mask& mask, int column, int row, double cell, Vec2 lo = {});

/// Exact outlines of the set cells along the cells' edges. There is one polygon, with its holes,
/// for each component of cells that touch by an edge or a corner; cells inside a hole are a
/// separate component. Collinear vertices are left out. Components are ordered by their topmost,
/// then leftmost cells. Throws InputError if `cell` is not above 0 or a coordinate is not finite.
std::vector<Polygon> mask_walls(const Mask& set, double cell, Vec2 lo = {});

/// Reduces the vertices of the outlines by Douglas–Peucker on each ring. Every removed vertex is at
/// most `tolerance` [µm] from the new outline. A ring never vanishes; rings may end up overlapping.
void simplify(std::vector<Polygon>& polygons, double tolerance);

}  // namespace microswarm::formats
