// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/formats/map_parts.hpp"

namespace microswarm::formats {

/// Angle [rad] by which a map of cells is turned that is said to be turned by `angle`: a whole
/// number of quarter turns, 0 for whole turns, if that moves none of its corners, at most
/// `diagonal` cells from the pivot, by more than a hundredth of a cell.
double map_turn(double angle, double diagonal);

/// Turns a map by `angle` [rad], counter-clockwise, about `pivot`. The new bounds are the smallest
/// upright box around it; what they add is a wall.
MapParts turned(MapParts parts, Vec2 pivot, double angle);

}  // namespace microswarm::formats
