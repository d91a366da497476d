// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm {

/// Gaussian mean around each pixel of a picture of floats, `spread` [px] being the standard
/// deviation. The Gaussian ends at 4 spreads, or at `reach` [px] where that is told; past the edge
/// the picture is continued by `border`, one of cv::BORDER_REFLECT_101 and its like. As
/// cv::GaussianBlur, which however has other bits on CPUs with fused multiply-add.
cv::Mat blurred(const cv::Mat& floats, double spread, int reach = 0,
                int border = cv::BORDER_REFLECT_101);

}  // namespace microswarm
