// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm::vision {

/// Float logarithm of an 8-bit picture after adding `by` and clamping to at least 1, and
/// exponential of floats in place. OpenCV's versions give different bits on different CPUs.
cv::Mat log_image(const cv::Mat& grey, double by);
void to_exponentials(cv::Mat& values);

}  // namespace microswarm::vision
