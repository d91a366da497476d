// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/world/obstacles/body.hpp"

namespace microswarm {

/// Walls as bodies whose `obstacle` numbers, from 0 in order of first appearance, name the
/// connected pieces. Polygons that overlap or share an edge are united into one; all others, and
/// discs, keep their coordinates. Pieces that touch in single points, and a disc and what it
/// overlaps, stay several bodies with one number. Polygons of no area are kept as they are. The
/// polygons must be `normalised` and finite.
std::vector<Body> connected_pieces(std::vector<Polygon> polygons, const std::vector<Disc>& discs);

}  // namespace microswarm
