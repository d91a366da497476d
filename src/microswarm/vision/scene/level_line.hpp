// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm::vision {

/// The closed contour of a piece of a field at `level`, by marching squares with linear
/// interpolation between pixels; (0, 0) is the centre of the first pixel, y points down. The piece
/// is 4-connected; `start` is the leftmost pixel of its top row. Where the piece meets the border
/// of the field, the contour follows the outer edge of its last pixels. `field` is of floats.
std::vector<Vec2> level_line(const cv::Mat& field, float level, cv::Point start);

}  // namespace microswarm::vision
