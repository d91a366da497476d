// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// One solid piece at one moment: a connected wall piece or a moving obstacle.
struct Body {
  std::variant<Disc, Polygon> shape;
  Vec2 velocity{};               ///< of its centre [µm/s]; zero for walls
  double deformation_speed = 0;  ///< bound on how fast its outline moves besides [µm/s]
  std::uint32_t obstacle = 0;    ///< which wall piece or obstacle it is (two leaves share one)
};

/// The outer ring of a polygon; null for a disc.
inline const std::vector<Vec2>* outline_of(const Body& body) {
  const auto* polygon = std::get_if<Polygon>(&body.shape);
  return polygon ? &polygon->outer : nullptr;
}

}  // namespace microswarm
