// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>

namespace microswarm::vision {

/// Gaussian blur of a float picture with standard deviation `spread` [px]. The kernel is cut at 4
/// standard deviations, or at `reach` [px] if it is above 0. The picture is extrapolated by
/// `border`, for example cv::BORDER_REFLECT_101. Same as cv::GaussianBlur, whose bits differ on
/// CPUs with fused multiply-add.
cv::Mat blurred(const cv::Mat& floats, double spread, int reach = 0,
                int border = cv::BORDER_REFLECT_101);

/// out = weight₀ · middle + Σ weightᵢ · (before + after), elementwise for `count` values; the
/// neighbours at distance i, at most `reach`, are `stride` · i values away.
void weigh_neighbours(const float* middle, std::ptrdiff_t stride, const float* weights, int reach,
                      int count, float* out);

}  // namespace microswarm::vision
