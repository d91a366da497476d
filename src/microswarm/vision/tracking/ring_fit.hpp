// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// A circle in a picture [px]; (0, 0) is the middle of the first pixel, y goes down.
struct Ring {
  Vec2 centre_px;
  double radius_px = 0;
};

/// The circle through points by least squares of |p − c|² − r² (Kåsa 1976); nothing for points on a
/// line.
std::optional<Ring> circle_through(const std::vector<Vec2>& points);

/// The dark circle (or bright one, unless `dark`) around `start`, whose radius is within half of
/// `radius` to either side: the extreme grey on each of many rays, a circle through these by least
/// squares (Kåsa 1976) without those far off, again from its centre until it stays. Nothing when
/// fewer than a third of the rays agree. `grey` has one channel.
std::optional<Ring> fit_ring(const Image& grey, Vec2 start, double radius, bool dark);

}  // namespace microswarm
