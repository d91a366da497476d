// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "microswarm/vision/vessels/vessels.hpp"

namespace microswarm {

/// Vessels as pixels of the whole picture (8-bit, 0 and 255), and what was measured on the way.
struct FoundVessels {
  cv::Mat vessels;
  double wide_width_px = 0;
  double scale = 1;
  int bridges = 0;
};

/// Vessels as lines that are darker (brighter when `bright`) than the ground beside them. `grey` is
/// 8-bit, one channel; `view` an 8-bit mask of the same size.
FoundVessels line_vessels(const cv::Mat& grey, const cv::Mat& view, bool bright,
                          const VesselParams& params);

}  // namespace microswarm
