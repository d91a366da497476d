// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "microswarm/vision/vessels/line_vessels.hpp"

namespace microswarm {

/// The two greys of a picture, told apart by Otsu's threshold.
struct TwoGreys {
  cv::Mat bright;           ///< 8-bit mask of the brighter side, in the view
  double separability = 0;  ///< share of the variance that the two means explain, 0 to 1
};

/// Splits `grey` (8-bit, one channel) within `view`, after a median against single bad pixels.
TwoGreys two_greys(const cv::Mat& grey, const cv::Mat& view);

/// Is the brighter side the network? A network is one piece, what it flows around is many: the side
/// of which a larger share is in one piece.
bool bright_is_network(const TwoGreys& greys, const cv::Mat& view);

/// Vessels as the dark or the bright side of two greys, without specks.
FoundVessels region_vessels(const TwoGreys& greys, const cv::Mat& view, bool bright,
                            const VesselParams& params);

}  // namespace microswarm
