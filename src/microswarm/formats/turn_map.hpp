// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/formats/map_parts.hpp"

namespace microswarm::formats {

/// Turns a map by `angle` [rad], counter-clockwise, about `pivot`. The new bounds are the smallest
/// upright box around it; what they add is a wall.
MapParts turned(MapParts parts, Vec2 pivot, double angle);

}  // namespace microswarm::formats
