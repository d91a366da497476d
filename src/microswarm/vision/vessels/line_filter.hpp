// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm {

/// Settings of `line_score`, in pixels of the picture given to it.
struct LineFilter {
  double wide_radius = 4.3;  ///< half the width of the wide lines; the scales follow from it
  int orientations = 12;
  double both_sides = 0.2;  ///< weight of the weaker side: an edge has one side only, a line two
};

/// How strongly each pixel looks like part of a bright line, from a bank of elongated detectors
/// over widths and orientations: mean along the line less the means along its two sides. Each
/// width's answer is divided by its spread within `view` (8-bit mask) and the answers are summed,
/// so that a line must show at neighbouring widths. `picture` is 32-bit, one channel, continued
/// smoothly outside the view. The result is 32-bit, of the same size; 0 where nothing varies.
cv::Mat line_score(const cv::Mat& picture, const cv::Mat& view, const LineFilter& filter);

}  // namespace microswarm
