// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/line_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/vision/image/blur.hpp"

namespace microswarm::vision {
namespace {

// Half widths of the bank relative to the wide radius.
constexpr double bank[] = {0.23, 0.35, 0.51, 0.77, 1.16, 1.63};
constexpr double blur = 0.6;           // of the half width
constexpr double side_distance = 2.0;  // of the half width, from the middle of the line
constexpr double length_growth = 2.0;  // half length: this many half widths ...
constexpr double min_length = 1.9;     // ... and this many wide radii
constexpr double flat_spread = 1e-4;   // responses that vary less are rounding errors
constexpr double finest_on_half =
    1.5;  // [px] half width that a picture of half the size still shows

struct Shift {
  int x = 0;
  int y = 0;
};

/// Offsets of the line's pixels from its middle, one per step along the longer axis.
std::vector<Shift> line_steps(double angle, int half_length) {
  const auto [sine, cosine] = maths::sincos(angle);
  std::vector<Shift> steps;
  for (int t = -half_length; t <= half_length; ++t)
    steps.push_back({cvRound(t * cosine), cvRound(t * sine)});
  return steps;
}

/// Means along the line at each pixel of `padded` that is at least `pad` from its border.
cv::Mat line_means(const cv::Mat& padded, int pad, const std::vector<Shift>& steps) {
  cv::Mat means(padded.rows - 2 * pad, padded.cols - 2 * pad, CV_32F);
  const float share = 1.0F / static_cast<float>(steps.size());
  for (int y = 0; y < means.rows; ++y) {
    float* const sum = means.ptr<float>(y);
    std::fill(sum, sum + means.cols, 0.0F);
    for (const Shift s : steps) {
      const float* const from = padded.ptr<float>(y + pad + s.y) + pad + s.x;
      for (int x = 0; x < means.cols; ++x) sum[x] += from[x];
    }
    for (int x = 0; x < means.cols; ++x) sum[x] *= share;
  }
  return means;
}

/// Bilinear sampling at a fixed offset: four weighted neighbours of every pixel.
struct Sampler {
  int x = 0;
  int y = 0;
  float w00 = 0, w01 = 0, w10 = 0, w11 = 0;

  Sampler(double dx, double dy) : x(cvFloor(dx)), y(cvFloor(dy)) {
    const double fx = dx - x;
    const double fy = dy - y;
    w00 = static_cast<float>((1 - fx) * (1 - fy));
    w01 = static_cast<float>(fx * (1 - fy));
    w10 = static_cast<float>((1 - fx) * fy);
    w11 = static_cast<float>(fx * fy);
  }
};

/// Raises `best` to the line response of one orientation, given the means along it.
void keep_better(cv::Mat& best, const cv::Mat& padded_means, int pad, double nx, double ny,
                 float weaker) {
  const Sampler left(nx, ny);
  const Sampler right(-nx, -ny);
  const auto row = [&](const Sampler& s, int y, int dy) {
    return padded_means.ptr<float>(y + pad + s.y + dy) + pad + s.x;
  };
  for (int y = 0; y < best.rows; ++y) {
    float* const out = best.ptr<float>(y);
    const float* const middle = padded_means.ptr<float>(y + pad) + pad;
    const float *const l0 = row(left, y, 0), *const l1 = row(left, y, 1);
    const float *const r0 = row(right, y, 0), *const r1 = row(right, y, 1);
    for (int x = 0; x < best.cols; ++x) {
      const float l =
          left.w00 * l0[x] + left.w01 * l0[x + 1] + left.w10 * l1[x] + left.w11 * l1[x + 1];
      const float r =
          right.w00 * r0[x] + right.w01 * r0[x + 1] + right.w10 * r1[x] + right.w11 * r1[x + 1];
      const float higher = std::max(l, r);
      const float answer = middle[x] - weaker * higher - (1.0F - weaker) * 0.5F * (l + r);
      out[x] = std::max(out[x], answer);
    }
  }
}

/// Maximum response over the orientations for lines of one half width, all in pixels of `picture`.
cv::Mat answers(const cv::Mat& picture, double half_width, int half_length,
                const LineFilter& filter) {
  const cv::Mat smooth = blurred(picture, std::max(0.3, blur * half_width));
  const double side = side_distance * half_width + 0.5;
  const int side_pad = cvCeil(side) + 2;
  const int pad = half_length + side_pad;
  cv::Mat padded;
  cv::copyMakeBorder(smooth, padded, pad, pad, pad, pad, cv::BORDER_REPLICATE);

  cv::Mat best(picture.size(), CV_32F, cv::Scalar(-1e9));
  for (int i = 0; i < filter.orientations; ++i) {
    const double angle = std::numbers::pi * i / filter.orientations;
    const auto [sine, cosine] = maths::sincos(angle);
    const cv::Mat means = line_means(padded, half_length, line_steps(angle, half_length));
    keep_better(best, means, side_pad, -side * sine, side * cosine,
                static_cast<float>(filter.both_sides));
  }
  return best;
}

}  // namespace

cv::Mat line_score(const cv::Mat& picture, const cv::Mat& view, const LineFilter& filter) {
  cv::Mat score = cv::Mat::zeros(picture.size(), CV_32F);
  cv::Mat small = picture;
  double shrink = 1;
  for (const double share : bank) {
    const double half_width = share * filter.wide_radius;
    while (half_width / (2 * shrink) >= finest_on_half && std::min(small.rows, small.cols) >= 2) {
      cv::resize(small, small, {(small.cols + 1) / 2, (small.rows + 1) / 2}, 0, 0, cv::INTER_AREA);
      shrink *= 2;
    }
    const double half_length = length_growth * half_width + min_length * filter.wide_radius;
    cv::Mat answer =
        answers(small, half_width / shrink, std::max(1, cvRound(half_length / shrink)), filter);
    if (shrink > 1) cv::resize(answer, answer, picture.size(), 0, 0, cv::INTER_LINEAR);
    cv::Scalar mean, spread;
    cv::meanStdDev(answer, mean, spread, view);
    if (spread[0] > flat_spread) score += answer / spread[0];
  }
  return score;
}

}  // namespace microswarm::vision
