// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "microswarm/vision/vessels/line_vessels.hpp"

namespace microswarm::vision {

/// A picture split into two greys by Otsu's threshold.
struct TwoGreys {
  cv::Mat bright;           ///< 8-bit mask of the brighter side, inside the view
  double separability = 0;  ///< fraction of the variance explained by the two means, 0 to 1
};

/// Splits `grey` (8-bit, one channel) within `view`, after a median filter against bad pixels.
TwoGreys two_greys(const cv::Mat& grey, const cv::Mat& view);

/// Whether the brighter side is the network: the side with the larger fraction of its area in one
/// piece. A network is connected; the tissue between its vessels is not.
bool bright_is_network(const TwoGreys& greys, const cv::Mat& view);

/// Segments vessels as the dark or the bright side of two greys and removes specks.
FoundVessels region_vessels(const TwoGreys& greys, const cv::Mat& view, bool bright,
                            const VesselParams& params);

}  // namespace microswarm::vision
