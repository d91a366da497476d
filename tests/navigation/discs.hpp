// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "microswarm/world/obstacles/body.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm::navigation {

/// A disc of 60 µm that moves.
inline Obstacle moving_disc(Motion motion) { return {DiscShape{60}, std::move(motion)}; }

/// A disc that stands.
inline Body disc_body(Vec2 c, double r, std::uint32_t obstacle = 0) {
  return {.shape = Disc{c, r}, .obstacle = obstacle};
}

}  // namespace microswarm::navigation
