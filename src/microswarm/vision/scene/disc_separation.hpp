// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/vision/tracking/ring_fit.hpp"

namespace microswarm::vision {

/// Limits of `separated_discs` [px].
struct DiscSeparation {
  double tolerance = 1;  ///< maximum distance of the outline from the circles
  double bridge = 4;     ///< maximum distance from two circles at once: where their images join
};

/// The discs whose images have joined in one outline: circles fitted to its points by least
/// squares, near where they are expected and about of the expected sizes. A disc with hardly any
/// visible outline keeps its expected position. Empty if the circles do not explain the outline.
std::vector<Ring> separated_discs(std::span<const Vec2> outline, std::span<const Ring> expected,
                                  const DiscSeparation& limits);

}  // namespace microswarm::vision
