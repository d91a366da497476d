// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm {

/// Natural logarithms of the greys of an 8-bit picture, each raised by `by` and taken as 1 at
/// least, as floats; and exponentials of floats in place. OpenCV's own have other bits on other
/// CPUs.
cv::Mat logs_of(const cv::Mat& grey, double by);
void to_exponentials(cv::Mat& values);

}  // namespace microswarm
