// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace microswarm::vision {

/// The float picture averaged along its lines and edges, by a bell of standard deviations `along`
/// and `across` [px], along at least 1: lines that noise hides pixel by pixel stand out, and their
/// walls stay in place. The means of all orientations are weighted by the fourth power of the
/// energy that they keep around the pixel: averaged across a line it is gone, averaged along it
/// stays. White noise is divided by √(4π · along · across) at least.
cv::Mat averaged_along(const cv::Mat& picture, double across, double along);

}  // namespace microswarm::vision
