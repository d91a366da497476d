// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// One solid piece at one moment: a connected wall piece or a moving obstacle.
struct Body {
  std::variant<Disc, Polygon> shape;
  Vec2 velocity{};               ///< of its centre [µm/s]; zero for walls
  double deformation_speed = 0;  ///< bound on how fast its outline moves besides [µm/s]
  std::uint32_t obstacle = 0;    ///< which wall piece or obstacle it is (two leaves share one)
};

}  // namespace microswarm
