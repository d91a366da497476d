// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm::formats {

/// Why the rings of a polygon enclose no clear area. Rings are numbered from 0, the outer one; they
/// may touch in points.
struct RingFault {
  enum class Kind {
    crosses_itself,  ///< the ring `first`
    rings_cross,     ///< the rings `first` and `second`
    hole_outside     ///< the ring `first` is outside the outer ring or within another hole
  };
  Kind kind{};
  std::size_t first = 0;
  std::size_t second = 0;
  Vec2 at{};  ///< a crossing, or a vertex of the hole
};

/// The first fault of a polygon whose rings are oriented as `Polygon` requires. Rings that touch,
/// or cross by less than a billionth of the extent, are judged by their area. Throws InputError as
/// `united`.
std::optional<RingFault> find_ring_fault(const Polygon& polygon);

}  // namespace microswarm::formats
