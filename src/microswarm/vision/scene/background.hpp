// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm {

/// The light on the ground of a picture, however uneven: a surface of second degree through the
/// median greys of tiles, in which tiles that do not fit count little. It holds as long as the
/// ground is more than half of what is seen. `grey` is 8-bit with one channel; pixels where `seen`
/// (8-bit, the same size, or empty) is 0 do not count. The surface is of floats.
cv::Mat ground_of(const cv::Mat& grey, const cv::Mat& seen);

}  // namespace microswarm
