// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Uniformly distributed point of the box; x is drawn before y.
inline Vec2 uniform_in(const Box& box, Rng& rng) {
  const double x = rng.uniform(box.lo.x, box.hi.x);
  return {x, rng.uniform(box.lo.y, box.hi.y)};
}

}  // namespace microswarm
