// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/walls.hpp"

#include <opencv2/imgproc.hpp>

#include "microswarm/vision/image/blur.hpp"
#include "microswarm/vision/image/mask_ops.hpp"

namespace microswarm::vision {
namespace {

constexpr double outward = 1.0 / 3;  // relative to the wide radius: how far a wall may move
constexpr double around = 3;  // relative to the wide radius: averaging range of the surroundings
constexpr double along = 1;   // the same for the line itself
constexpr double noise_blur = 1;  // [px]

/// Gaussian mean over the pixels of `where` only; 0 far from all of them.
cv::Mat mean_over(const cv::Mat& picture, const cv::Mat& where, double sigma) {
  cv::Mat weight;
  where.convertTo(weight, CV_32F, 1.0 / 255);
  const cv::Mat sum = blurred(picture.mul(weight), sigma);
  weight = blurred(weight, sigma);
  return sum / cv::max(weight, 1e-6);
}

}  // namespace

cv::Mat fitted_walls(const cv::Mat& picture, const cv::Mat& lines, const cv::Mat& view,
                     double wide_radius, double level) {
  const cv::Mat reach = grown(lines, outward * wide_radius) & view;
  const cv::Mat within = mean_over(picture, lines, along * wide_radius);
  const cv::Mat outside = mean_over(picture, view & ~reach, around * wide_radius);
  const cv::Mat smooth = blurred(picture, noise_blur);
  return (smooth > outside + level * (within - outside)) & reach;
}

}  // namespace microswarm::vision
