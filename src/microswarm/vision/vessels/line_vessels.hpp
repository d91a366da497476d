// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "microswarm/vision/vessels/vessels.hpp"

namespace microswarm::vision {

/// Vessel pixels of the whole picture (8-bit, 0 and 255) and measured quantities.
struct FoundVessels {
  cv::Mat vessels{};
  double wide_width_px = 0;
  double scale = 1;
  int bridges = 0;
};

/// The odds that lines in the picture are bright, above 0; 1 if both may be. The line score of
/// vessels has a long tail above its median; the score of what lies between them has not.
double odds_of_bright_lines(const cv::Mat& grey, const cv::Mat& view);

/// Segments vessels as lines darker (brighter if `bright`) than the adjacent background. `grey` is
/// 8-bit with one channel; `view` is an 8-bit mask of the same size. `stop` ends it without
/// vessels.
FoundVessels line_vessels(const cv::Mat& grey, const cv::Mat& view, bool bright,
                          const VesselParams& params, const Stop& stop = {});

}  // namespace microswarm::vision
