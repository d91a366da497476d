// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm {

/// Sets the walls of roughly found bright lines where the picture itself has them: at `level`
/// between the brightness around (0) and the brightness within (1), both averaged nearby. A wall
/// moves outwards by at most a third of `wide_radius` [px], and only within `view`.
cv::Mat fitted_walls(const cv::Mat& picture, const cv::Mat& lines, const cv::Mat& view,
                     double wide_radius, double level);

}  // namespace microswarm
