// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/along_lines.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/vision/image/blur.hpp"

namespace microswarm::vision {
namespace {

constexpr int orientations = 16;
constexpr double bell_ends = 2.5;    // standard deviations
constexpr double line_ground = 2;    // of the standard deviation along: what is no line
constexpr double line_energy = 3;    // [px] around a pixel; wider, a line covers its branches
constexpr float min_energy = 1e-6F;  // of a flat picture

struct BellPoint {
  int x = 0;
  int y = 0;
  float weight = 0;
};

/// Pixels of a bell along a line, one per step along the longer axis, with a sum of 1.
std::vector<BellPoint> bell_along(double angle, double spread) {
  const auto [sine, cosine] = maths::sincos(angle);
  const double step = 1 / std::max(std::abs(sine), std::abs(cosine));
  const int reach = std::max(1, cvRound(bell_ends * spread / step));
  std::vector<BellPoint> points;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    const double t = i * step;
    const double weight = maths::exp(-0.5 * t * t / (spread * spread));
    points.push_back({cvRound(t * cosine), cvRound(t * sine), static_cast<float>(weight)});
    sum += weight;
  }
  for (BellPoint& p : points) p.weight = static_cast<float>(p.weight / sum);
  return points;
}

MICROSWARM_EACH_CPU void add_weighted(const float* values, float weight, int count, float* sums) {
  for (int x = 0; x < count; ++x) sums[x] += weight * values[x];
}

/// Adds the means of one orientation, weighted by their energies.
MICROSWARM_EACH_CPU void add_means(const float* means, const float* energies, int count,
                                   float* sums, float* weights) {
  for (int x = 0; x < count; ++x) {
    const float energy = energies[x] + min_energy;
    const float weight = (energy * energy) * (energy * energy);
    sums[x] += weight * means[x];
    weights[x] += weight;
  }
}

}  // namespace

cv::Mat averaged_along(const cv::Mat& picture, double across, double along) {
  assert(picture.type() == CV_32F && along >= 1 && along > across);
  const cv::Mat smooth = blurred(picture, across);
  const double spread = std::sqrt(along * along - across * across);
  const int pad = cvCeil(bell_ends * spread) + 1;
  cv::Mat wide;
  cv::copyMakeBorder(smooth, wide, pad, pad, pad, pad, cv::BORDER_REFLECT_101);
  const cv::Mat ground = blurred(picture, line_ground * along);
  cv::Mat sums = cv::Mat::zeros(picture.size(), CV_32F);
  cv::Mat weights = cv::Mat::zeros(picture.size(), CV_32F);
  for (int i = 0; i < orientations; ++i) {
    const auto points = bell_along(std::numbers::pi * i / orientations, spread);
    cv::Mat means = cv::Mat::zeros(picture.size(), CV_32F);
    for (int y = 0; y < means.rows; ++y)
      for (const BellPoint& p : points)
        add_weighted(wide.ptr<float>(y + pad + p.y) + pad + p.x, p.weight, means.cols,
                     means.ptr<float>(y));
    const cv::Mat lines = means - ground;
    const cv::Mat energies = blurred(lines.mul(lines), line_energy);
    for (int y = 0; y < means.rows; ++y)
      add_means(means.ptr<float>(y), energies.ptr<float>(y), means.cols, sums.ptr<float>(y),
                weights.ptr<float>(y));
  }
  return sums / weights;
}

}  // namespace microswarm::vision
