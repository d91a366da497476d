// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm::vision {

/// Fits the walls of roughly found bright lines to the picture: the wall is at `level` between the
/// local mean brightness around the line (0) and inside it (1). A wall moves outwards by at most a
/// third of `wide_radius` [px], and only within `view`.
cv::Mat fitted_walls(const cv::Mat& picture, const cv::Mat& lines, const cv::Mat& view,
                     double wide_radius, double level);

}  // namespace microswarm::vision
