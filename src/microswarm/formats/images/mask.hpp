// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// A set of square cells: 1 = set, 0 = not; row by row, y down.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cells;  ///< width · height

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

/// Sets the cells whose grey (luma, for colours) is below `level` when `dark_is_set`, or else those
/// at or above it: the two masks are each other's complement.
Mask threshold(const Image& image, int level, bool dark_is_set);

/// The box that the cells cover: `cell` [µm] is their side, `lo` the world's lower left corner.
Box cell_bounds(const Mask& mask, double cell, Vec2 lo = {});

/// World centre [µm] of a cell: the image boundary is crossed here, columns go right and rows down
/// in files, x goes right and y up in the world. Cell (column, row) covers
/// lo + [column, column + 1] · cell × [height − row − 1, height − row] · cell.
Vec2 cell_centre(const Mask& mask, int column, int row, double cell, Vec2 lo = {});

/// Outlines of the set cells along the cells' edges, exactly: one polygon for each piece of cells
/// that touch by an edge or a corner, with its holes; what stands in a hole is a piece of its own.
/// Vertices in a straight line are left out. The order is that of the pieces' topmost, then
/// leftmost cells. Throws InputError when `cell` is not above 0 or a coordinate is not finite.
std::vector<Polygon> mask_walls(const Mask& set, double cell, Vec2 lo = {});

/// Outlines with fewer vertices, of which every vertex left out is at most `tolerance` [µm] from
/// the new outline (Douglas–Peucker on each ring). A ring never vanishes; rings may come to
/// overlap.
void simplify(std::vector<Polygon>& polygons, double tolerance);

}  // namespace microswarm
