// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm::vision {

/// Settings of `line_score`, in pixels of its picture.
struct LineFilter {
  double wide_radius = 4.3;  ///< half the width of wide lines; determines the scales
  int orientations = 12;
  double both_sides = 0.2;  ///< weight of the weaker side: an edge has one side, a line two
};

/// Score of each pixel as part of a bright line, from a bank of elongated detectors over widths and
/// orientations. The response is the mean along the line minus the means along its two sides. The
/// response of each width is divided by its spread within `view` (8-bit mask), and the responses
/// are summed, so a line must respond at neighbouring widths. `picture` is 32-bit with one channel
/// and extrapolated smoothly outside the view. The result is 32-bit, of the same size; 0 where the
/// picture is constant.
cv::Mat line_score(const cv::Mat& picture, const cv::Mat& view, const LineFilter& filter);

}  // namespace microswarm::vision
