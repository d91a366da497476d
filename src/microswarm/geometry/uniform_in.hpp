// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Uniformly distributed point of the box; x is drawn before y.
inline Vec2 uniform_in(const Box& box, Rng& rng) {
  const double x = rng.uniform(box.lo.x, box.hi.x);
  return {x, rng.uniform(box.lo.y, box.hi.y)};
}

/// The points that the next calls of `uniform_in` will give, as many as `ahead` has room for, at
/// most half of Rng::max_ahead, without drawing them; each takes two numbers.
inline void look_ahead(const Box& box, Rng& rng, std::span<Vec2> ahead) {
  const auto bits = rng.ahead(2 * ahead.size());
  for (std::size_t i = 0; i < ahead.size(); ++i)
    ahead[i] = {box.lo.x + (box.hi.x - box.lo.x) * Rng::to_uniform(bits[2 * i]),
                box.lo.y + (box.hi.y - box.lo.y) * Rng::to_uniform(bits[2 * i + 1])};
}

}  // namespace microswarm
