// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace microswarm::vision {

/// A polynomial over a picture: factors of 1, x, y, x², xy, y², …, with x and y from −1 to 1.
struct LightPolynomial {
  int degree = 0;  ///< at most 4
  std::vector<double> factors{0.0};

  /// Its value at the centre of each pixel, 32-bit.
  cv::Mat over(cv::Size size) const;
};

/// Light on a ground, and what a set of pixels adds to it.
struct LightFit {
  LightPolynomial light{};
  LightPolynomial contrast{};  ///< 0 without a set
};

/// Least squares of grey = light + set · contrast within `view`, on at most some 40,000 pixels.
/// `grey` and `set` are 32-bit, `set` from 0 to 1 or empty. Where the set does not determine it,
/// the contrast is even.
LightFit fit_light(const cv::Mat& grey, const cv::Mat& set, const cv::Mat& view, int degree,
                   int contrast_degree);

}  // namespace microswarm::vision
