// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm::vision {

/// One of six colours safe for colour-blind readers (Okabe & Ito), by a robot's id.
cv::Scalar track_colour(int id);

/// Draws a scale bar with its length at the lower left.
void draw_scale_bar(cv::Mat& picture, double um_per_px);

}  // namespace microswarm::vision
