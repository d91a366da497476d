// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/blur.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::vision {
namespace {

constexpr int ends_at = 4;  // standard deviations

/// Weights of the pixel itself and of its neighbours on either side, normalised to a sum of 1.
std::vector<float> bell(double spread, int reach) {
  std::vector<double> half;
  double sum = 0;
  for (int i = 0; i <= reach; ++i) {
    half.push_back(maths::exp(-0.5 * i * i / (spread * spread)));
    sum += (i == 0 ? 1 : 2) * half.back();
  }
  std::vector<float> weights;
  weights.reserve(half.size());
  for (const double w : half) weights.push_back(static_cast<float>(w / sum));
  return weights;
}

}  // namespace

MICROSWARM_EACH_CPU void weigh_neighbours(const float* middle, std::ptrdiff_t stride,
                                          const float* weights, int reach, int count, float* out) {
  constexpr int block = 32;  // values whose sums stay in registers
  int x = 0;
  for (; x + block <= count; x += block) {
    float sums[block];
    for (int k = 0; k < block; ++k) sums[k] = weights[0] * middle[x + k];
    for (int i = 1; i <= reach; ++i) {
      const float* before = middle + x - i * stride;
      const float* after = middle + x + i * stride;
      for (int k = 0; k < block; ++k) sums[k] += weights[i] * (before[k] + after[k]);
    }
    for (int k = 0; k < block; ++k) out[x + k] = sums[k];
  }
  for (; x < count; ++x) {
    float sum = weights[0] * middle[x];
    for (int i = 1; i <= reach; ++i)
      sum += weights[i] * (middle[x - i * stride] + middle[x + i * stride]);
    out[x] = sum;
  }
}

cv::Mat blurred(const cv::Mat& floats, double spread, int reach, int border) {
  assert(floats.type() == CV_32F && spread > 0);
  if (reach <= 0) reach = std::max(1, cvRound(ends_at * spread));
  const std::vector<float> weights = bell(spread, reach);
  cv::Mat wide;
  cv::copyMakeBorder(floats, wide, reach, reach, reach, reach, border);
  const auto stride = static_cast<std::ptrdiff_t>(wide.step1());
  std::vector<float> row(static_cast<std::size_t>(wide.cols));
  cv::Mat out(floats.size(), CV_32F);
  for (int y = 0; y < out.rows; ++y) {
    weigh_neighbours(wide.ptr<float>(y + reach), stride, weights.data(), reach, wide.cols,
                     row.data());
    weigh_neighbours(row.data() + reach, 1, weights.data(), reach, out.cols, out.ptr<float>(y));
  }
  return out;
}

}  // namespace microswarm::vision
