// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/vision/vessels/light_fit.hpp"

namespace microswarm::vision {

/// A picture as two levels under uneven light: grey = light(x, y) + contrast(x, y) · set + noise.
/// The light is a polynomial and what wide means of the rest add to it.
struct TwoLevels {
  LightFit fit{};       ///< the set is the brighter level
  cv::Mat residual{};   ///< light beyond its polynomial [grey], 32-bit, of a smaller picture
  double contrast = 0;  ///< mean difference of the levels [grey]; 0 if there are not two
  double noise = 0;     ///< standard deviation of the noise of a pixel [grey]
  /// Share of the variance that the two levels explain, of what light alone and noise do not: near
  /// 1 for a chip or a stained network, 0.5 to 0.7 for a fundus photograph, up to 0.85 for a small
  /// part of one. 0 if there are not two levels.
  double explained = 0;
  int tried = 0;  ///< first sets from which it was fitted; one is enough for a clear picture
};

/// Fits two levels to `grey` (8-bit, one channel) within `view`, on a smaller picture: from a few
/// first sets of pixels, light and levels are fitted and pixels are assigned in turn, and the one
/// that leaves the least squares is taken. `stop` ends it with no levels.
TwoLevels fit_two_levels(const cv::Mat& grey, const cv::Mat& view, const Stop& stop = {});

/// The picture without light and noise: 0 where it is of the darker level, 1 where it is of the
/// brighter one, 32-bit. Edges stay where the picture crosses the middle of the levels.
cv::Mat level_picture(const cv::Mat& grey, const TwoLevels& levels, const Stop& stop = {});

}  // namespace microswarm::vision
