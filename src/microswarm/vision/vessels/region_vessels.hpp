// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "microswarm/vision/vessels/line_vessels.hpp"

namespace microswarm::vision {

/// A picture split into two greys by Otsu's threshold.
struct TwoGreys {
  cv::Mat bright{};         ///< 8-bit mask of the brighter side, inside the view
  double separability = 0;  ///< fraction of the variance explained by the two means, 0 to 1
};

/// Splits `grey` (8-bit, one channel) within `view`, after a median filter against bad pixels.
TwoGreys two_greys(const cv::Mat& grey, const cv::Mat& view);

/// The odds that the brighter of two levels is the network, above 0; 1 if both may be. A network
/// is connected and narrow; what it separates is in pieces and wide. `bright` is the brighter
/// level, an 8-bit mask within `view`.
double odds_of_bright_network(const cv::Mat& bright, const cv::Mat& view);

/// Segments vessels in a picture of levels, 0 to 1 (`level_picture`), and removes specks.
FoundVessels region_vessels(const cv::Mat& levels, const cv::Mat& view, bool bright,
                            const VesselParams& params);

}  // namespace microswarm::vision
