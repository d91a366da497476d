// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// The closed line around a piece of a field at which it falls to `level`, by marching squares with
/// linear interpolation between pixels; (0, 0) is the middle of the first pixel, y goes down. The
/// piece holds together by edges; `start` is the leftmost pixel of its top row. Where the piece
/// leaves the field, the line runs along the outer edge of its last pixels. `field` is of floats.
std::vector<Vec2> level_line(const cv::Mat& field, float level, cv::Point start);

}  // namespace microswarm
