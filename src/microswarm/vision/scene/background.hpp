// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm {

/// Background intensity of a picture with uneven light: a quadratic surface fitted robustly to the
/// medians of tiles. Valid if the background covers more than half of the seen pixels. `grey` is
/// 8-bit with one channel; pixels where `seen` (8-bit, same size, or empty) is 0 are ignored. The
/// result is a float matrix.
cv::Mat ground_of(const cv::Mat& grey, const cv::Mat& seen);

}  // namespace microswarm
