// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/band_pass.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm {
namespace {

constexpr double cut = 4;  // standard deviations at which the Gaussian is cut

std::vector<float> gaussian(double spread) {
  if (spread <= 0) return {1.0F};
  const int reach = static_cast<int>(std::lround(cut * spread));
  std::vector<double> half;
  double sum = 0;
  for (int i = 0; i <= reach; ++i) {
    half.push_back(maths::exp(-0.5 * i * i / (spread * spread)));
    sum += (i == 0 ? 1 : 2) * half.back();
  }
  std::vector<float> taps;
  taps.reserve(half.size());
  for (const double tap : half) taps.push_back(static_cast<float>(tap / sum));
  return taps;
}

const std::uint8_t* row_of(const Image& grey, int row) {
  return grey.pixels.data() + grey.index(0, std::clamp(row, 0, grey.height - 1));
}

/// Fills the margins on both sides of `width` values with the first and the last value.
template <class T>
void extend(std::vector<T>& row, int margin, int width) {
  std::fill_n(row.begin(), margin, row[margin]);
  std::fill_n(row.begin() + margin + width, margin, row[margin + width - 1]);
}

/// Integer part of (offset + sign · in) / by. The sums are far below 2^22, so adding one half to
/// the numerator makes the truncated float product exact.
MICROSWARM_EACH_CPU void divide(const std::int32_t* in, int count, std::int32_t sign,
                                std::int32_t offset, int by, std::int32_t* out) {
  const float share = 1.0F / static_cast<float>(by);
  for (int x = 0; x < count; ++x)
    out[x] = static_cast<std::int32_t>((static_cast<float>(offset + sign * in[x]) + 0.5F) * share);
}

}  // namespace

BandPass::BandPass(const BandPassParams& params)
    : params_(params), taps_(gaussian(params.noise_px)) {
  assert(params.box_px % 2 == 1);
}

const std::vector<float>& BandPass::filter(const Image& grey) {
  assert(grey.channels == 1);
  begin(grey);
  for (int row = 0; row < grey.height; ++row) {
    smooth_down(grey, row);
    find_ground(grey, row);
    write_row(grey.width, result_.data() + grey.index(0, row));
  }
  return result_;
}

void BandPass::begin(const Image& grey) {
  const int reach = static_cast<int>(taps_.size()) - 1;
  const int half = params_.box_px / 2;
  const auto width = static_cast<std::size_t>(grey.width);
  smoothed_.resize(width + 2 * reach);
  column_sums_.assign(width, 0);
  column_means_.resize(width + 2 * half);
  ground_.resize(width);
  result_.resize(grey.pixels.size());
  for (int row = -half - 1; row < half; ++row) {  // the box before the first row
    const std::uint8_t* in = row_of(grey, row);
    for (int x = 0; x < grey.width; ++x) column_sums_[x] += in[x];
  }
}

MICROSWARM_EACH_CPU void BandPass::smooth_down(const Image& grey, int row) {
  const int reach = static_cast<int>(taps_.size()) - 1;
  float* out = smoothed_.data() + reach;
  const std::uint8_t* middle = row_of(grey, row);
  for (int x = 0; x < grey.width; ++x) out[x] = taps_[0] * static_cast<float>(middle[x]);
  for (int i = 1; i <= reach; ++i) {
    const float tap = taps_[i];
    const std::uint8_t* above = row_of(grey, row - i);
    const std::uint8_t* below = row_of(grey, row + i);
    for (int x = 0; x < grey.width; ++x) out[x] += tap * static_cast<float>(above[x] + below[x]);
  }
  extend(smoothed_, reach, grey.width);
}

MICROSWARM_EACH_CPU void BandPass::find_ground(const Image& grey, int row) {
  const int half = params_.box_px / 2;
  const std::uint8_t* enters = row_of(grey, row + half);
  const std::uint8_t* leaves = row_of(grey, row - half - 1);
  std::int32_t* sums = column_sums_.data();
  for (int x = 0; x < grey.width; ++x) sums[x] += enters[x] - leaves[x];
  const std::int32_t top = params_.dark_rises ? 255 * params_.box_px : 0;
  const std::int32_t sign = params_.dark_rises ? -1 : 1;
  std::int32_t* means = column_means_.data();
  divide(sums, grey.width, sign, top, params_.box_px, means + half);
  extend(column_means_, half, grey.width);
  std::int32_t* ground = ground_.data();
  std::int32_t sum = 0;
  for (int i = 0; i < params_.box_px; ++i) sum += means[i];
  ground[0] = sum;
  const std::int32_t* next = means + params_.box_px;
  for (int x = 1; x < grey.width; ++x) ground[x] = sum += next[x - 1] - means[x - 1];
  divide(ground, grey.width, 1, 0, params_.box_px, ground);
}

MICROSWARM_EACH_CPU void BandPass::write_row(int width, float* out) const {
  const int reach = static_cast<int>(taps_.size()) - 1;
  const float* in = smoothed_.data() + reach;
  for (int x = 0; x < width; ++x) out[x] = taps_[0] * in[x];
  for (int i = 1; i <= reach; ++i)
    for (int x = 0; x < width; ++x) out[x] += taps_[i] * (in[x - i] + in[x + i]);
  const float top = params_.dark_rises ? 255.0F : 0.0F;
  const float sign = params_.dark_rises ? -1.0F : 1.0F;
  const float least = static_cast<float>(params_.min_foreground);
  for (int x = 0; x < width; ++x) {
    const float rise = top + sign * out[x] - static_cast<float>(ground_[x]);
    out[x] = rise >= least ? rise : 0.0F;
  }
}

}  // namespace microswarm
