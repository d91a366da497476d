// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm::vision {

/// OpenCV draws with a resolution of 1/16 pixel.
inline constexpr int fraction_bits = 4;

/// A position in the picture [px] in units of 1/16 pixel.
inline cv::Point fine(Vec2 p) {
  return {static_cast<int>(std::lround(p.x * (1 << fraction_bits))),
          static_cast<int>(std::lround(p.y * (1 << fraction_bits)))};
}

/// Colour of lines and text.
inline const cv::Scalar white(255, 255, 255);
inline const cv::Scalar black(0, 0, 0);

/// Writes a line of ASCII text in white with a black edge; `at` is its lower left corner.
inline void draw_text(cv::Mat& picture, const std::string& text, cv::Point at, double size) {
  const int thin = std::max(1, static_cast<int>(std::lround(2 * size)));
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, black, 3 * thin, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, white, thin, cv::LINE_AA);
}

}  // namespace microswarm::vision
