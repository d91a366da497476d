// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <opencv2/core.hpp>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// OpenCV draws with a resolution of 1/16 pixel.
inline constexpr int fraction_bits = 4;

/// A position in the picture [px] in units of 1/16 pixel.
inline cv::Point fine(Vec2 p) {
  return {static_cast<int>(std::lround(p.x * (1 << fraction_bits))),
          static_cast<int>(std::lround(p.y * (1 << fraction_bits)))};
}

/// Colour of lines and text.
inline const cv::Scalar white(255, 255, 255);

}  // namespace microswarm
