// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Sum of the magnitudes of the coordinates: bounds their rounding.
inline double l1_norm(Vec2 p) { return std::abs(p.x) + std::abs(p.y); }

}  // namespace microswarm
