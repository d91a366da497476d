// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Smooth outlines of the set cells: a polygon for each piece of cells that touch by an edge, with
/// its holes, in the order of the pieces' first cells. Cell (column, row) covers
/// lo + [column, column + 1] · cell × [height − row − 1, height − row] · cell, in µm. An outline
/// starts as the line through the middles of the cells' edges and ends within `tolerance` [µm] of
/// it: half is spent on smoothing (at most half a cell), half on leaving out vertices. So a passage
/// becomes at most twice the tolerance narrower or wider, and no ring ever touches itself or
/// another, by exact tests of every step. Throws InputError when `cell` is not above 0 or
/// `tolerance` is below 0 or something is not finite.
std::vector<Polygon> outline(const Mask& mask, double cell, double tolerance, Vec2 lo = {});

/// The walls around a network of set cells: the outline of all other cells and of one more ring of
/// cells around the mask, so that walls reach beyond its border.
std::vector<Polygon> walls_around(const Mask& network, double cell, double tolerance, Vec2 lo = {});

}  // namespace microswarm
