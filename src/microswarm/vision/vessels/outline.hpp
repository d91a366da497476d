// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm::vision {

/// Smooth outlines of the set cells: a polygon with holes for each 4-connected piece, in the order
/// of the pieces' first cells. Cell (column, row) covers lo + [column, column + 1] · cell × [height
/// − row − 1, height − row] · cell, in µm. An outline starts as the line through the midpoints of
/// the cells' edges and stays within `tolerance` [µm] of it: half is used for smoothing (at most
/// half a cell), half for removing vertices. A passage therefore changes its width by at most twice
/// the tolerance. Exact tests at every step ensure that no ring touches itself or another. Throws
/// InputError if `cell` is not above 0, `tolerance` is below 0, or a value is not finite. `stop`
/// leaves more vertices, less smooth.
std::vector<Polygon> outline(const formats::Mask& mask, double cell, double tolerance, Vec2 lo = {},
                             const Stop& stop = {});

/// Walls around a network of set cells: the outline of all other cells, extended by one ring of
/// cells around the mask so that walls reach beyond its border.
std::vector<Polygon> walls_around(const formats::Mask& network, double cell, double tolerance,
                                  Vec2 lo = {}, const Stop& stop = {});

}  // namespace microswarm::vision
