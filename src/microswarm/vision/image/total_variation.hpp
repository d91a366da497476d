// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "microswarm/core/execution/stop.hpp"

namespace microswarm::vision {

/// The float picture u that minimises ½ Σ (u − picture)² + weight · Σ |∇u|: noise goes, edges stay
/// where they are. For a picture of two greys, the pixels of u above the middle of the two are the
/// set with the least sum of squared errors and perimeter. Fast gradient projection on the dual
/// (Beck and Teboulle 2009), a fixed number of steps; `stop` ends it earlier.
cv::Mat without_noise(const cv::Mat& picture, double weight, int steps, const Stop& stop = {});

}  // namespace microswarm::vision
