// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/world/obstacles/body.hpp"

namespace microswarm {

/// Walls as bodies. Their `obstacle` numbers identify the connected pieces, from 0 in order of
/// first appearance. Polygons that overlap or share an edge are united. All other polygons and the
/// discs keep their coordinates. Pieces that touch in single points, and a disc and what it
/// overlaps, remain separate bodies with the same number. Polygons of zero area are kept. The
/// polygons must be `normalised` and finite.
std::vector<Body> connected_pieces(std::vector<Polygon> polygons, const std::vector<Disc>& discs);

}  // namespace microswarm
