// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/rasterise.hpp"

#include <cmath>
#include <cstdint>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {
namespace {

/// Number of cells along a length; an overhang below a millionth of a cell is ignored.
std::int64_t cells_along(double length, double cell) {
  const double cells = std::ceil(length / cell - 1e-6);
  return cells < 1 ? 1 : static_cast<std::int64_t>(std::min(cells, 1e15));
}

}  // namespace

Mask rasterise(const Map& map, double cell) {
  if (!(cell > 0) || !std::isfinite(cell))
    throw InputError("cell of " + number_text(cell) + " µm: must be above 0");
  const std::int64_t width = cells_along(map.bounds().width(), cell);
  const std::int64_t height = cells_along(map.bounds().height(), cell);
  check_image_size(width, height, "map in cells of " + number_text(cell) + " µm", "cells");
  const Mask shape(static_cast<int>(width), static_cast<int>(height));
  return blocked_cells(map, shape.width, shape.height, [&](int column, int row) {
    return cell_centre(shape, column, row, cell, map.bounds().lo);
  });
}

}  // namespace microswarm::formats
