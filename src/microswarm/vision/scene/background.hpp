// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace microswarm::vision {

/// Background intensity of a picture with uneven light: a quadratic surface fitted robustly to the
/// medians of tiles. Valid if the background covers more than half of the seen pixels. `grey` is
/// 8-bit with one channel; pixels where `seen` (8-bit, same size, or empty) is 0 are ignored. The
/// result is a float matrix.
cv::Mat estimate_background(const cv::Mat& grey, const cv::Mat& seen);

/// That surface, to be evaluated at other pixels than it was fitted to.
class GroundSurface {
 public:
  /// As in `estimate_background`.
  GroundSurface(const cv::Mat& grey, const cv::Mat& seen);

  /// Pixels of another picture: the first one is at (x, y) in the fitted picture, and the others
  /// follow at distances of `step`.
  struct Grid {
    double x = 0;
    double y = 0;
    double step = 1;
    cv::Size size{};
  };
  /// Float matrix of the background there.
  cv::Mat over(const Grid& grid) const;

 private:
  bool has_tiles_ = false;
  double half_;  // of the longer side
  double middle_x_;
  double middle_y_;
  std::array<double, 6> factor_{};
};

}  // namespace microswarm::vision
