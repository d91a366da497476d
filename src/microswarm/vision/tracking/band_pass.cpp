// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/band_pass.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/vision/image/blur.hpp"

namespace microswarm::vision {
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

const std::uint8_t* pixel_row(const formats::Image& grey, int row) {
  return grey.pixels.data() + grey.index(0, std::clamp(row, 0, grey.height - 1));
}

/// Fills the margins on both sides of `width` values with the first and the last value.
template <class T>
void extend(std::vector<T>& row, int margin, int width) {
  std::fill_n(row.begin(), margin, row[margin]);
  std::fill_n(row.begin() + margin + width, margin, row[margin + width - 1]);
}

MICROSWARM_EACH_CPU void convert(const std::uint8_t* in, int count, float* out) {
  for (int x = 0; x < count; ++x) out[x] = static_cast<float>(in[x]);
}

/// Sums of `box` successive values, from the binary digits of `box`: `values`, count + box - 1 of
/// them, are replaced by sums of 2, 4, 8, … of them.
MICROSWARM_EACH_CPU void sum_boxes(std::int32_t* values, int count, int box, std::int32_t* out) {
  std::fill_n(out, count, 0);
  const int all = count + box - 1;
  for (int length = 1, summed = 0; length <= box; length *= 2) {
    if (box & length) {
      const std::int32_t* next = values + summed;
      for (int x = 0; x < count; ++x) out[x] += next[x];
      summed += length;
    }
    if (2 * length > box) return;
    for (int x = 0; x + 2 * length <= all; ++x) values[x] += values[x + length];
  }
}

/// Integer part of (offset + sign · in) / by. The sums are far below 2^22, so adding one half to
/// the numerator makes the truncated float product exact.
MICROSWARM_EACH_CPU void divide(const std::int32_t* in, int count, std::int32_t sign,
                                std::int32_t offset, int by, std::int32_t* out) {
  const float share = 1.0F / static_cast<float>(by);
  for (int x = 0; x < count; ++x)
    out[x] = static_cast<std::int32_t>((static_cast<float>(offset + sign * in[x]) + 0.5F) * share);
}

/// Adds the row that enters the box to the column sums and subtracts the one that leaves it.
MICROSWARM_EACH_CPU void move_down(const std::uint8_t* enters, const std::uint8_t* leaves,
                                   int count, std::int32_t* sums) {
  for (int x = 0; x < count; ++x) sums[x] += enters[x] - leaves[x];
}

/// Contrast to the background if it is at least `least`; else 0.
MICROSWARM_EACH_CPU void subtract(const std::int32_t* ground, int count, float top, float sign,
                                  float least, float* out) {
  for (int x = 0; x < count; ++x) {
    const float rise = top + sign * out[x] - static_cast<float>(ground[x]);
    out[x] = rise >= least ? rise : 0.0F;
  }
}

}  // namespace

BandPass::BandPass(const BandPassParams& params)
    : params_(params), taps_(gaussian(params.noise_px)) {
  assert(params.box_px % 2 == 1);
}

const std::vector<float>& BandPass::filter(const formats::Image& grey) {
  assert(grey.channels == 1);
  begin(grey);
  for (int row = 0; row < grey.height; ++row) {
    smooth_down(grey, row);
    find_ground(grey, row);
    write_row(grey.width, result_.data() + grey.index(0, row));
  }
  return result_;
}

void BandPass::begin(const formats::Image& grey) {
  const int reach = static_cast<int>(taps_.size()) - 1;
  const int half = params_.box_px / 2;
  const auto width = static_cast<std::size_t>(grey.width);
  rows_.resize(2 * static_cast<std::size_t>(2 * reach + 1) * width);
  for (int row = -reach; row < reach; ++row) take_row(grey, row);
  smoothed_.resize(width + 2 * reach);
  column_sums_.assign(width, 0);
  column_means_.resize(width + 2 * half);
  ground_.resize(width);
  result_.resize(grey.pixels.size());
  for (int row = -half - 1; row < half; ++row) {  // the box before the first row
    const std::uint8_t* in = pixel_row(grey, row);
    for (int x = 0; x < grey.width; ++x) column_sums_[x] += in[x];
  }
}

/// The row as numbers, in the place of one that is needed no more, and once more behind all of
/// them: so those around a row are always in order.
void BandPass::take_row(const formats::Image& grey, int row) {
  const auto width = static_cast<std::size_t>(grey.width);
  const int rows = 2 * static_cast<int>(taps_.size()) - 1;
  float* position = rows_.data() + static_cast<std::size_t>((row + rows) % rows) * width;
  convert(pixel_row(grey, row), grey.width, position);
  std::copy_n(position, width, position + static_cast<std::size_t>(rows) * width);
}

void BandPass::smooth_down(const formats::Image& grey, int row) {
  const int reach = static_cast<int>(taps_.size()) - 1;
  const int rows = 2 * reach + 1;
  take_row(grey, row + reach);
  const int middle = (row + reach + 1) % rows + reach;  // that around which the oldest is first
  weigh_neighbours(rows_.data() + static_cast<std::size_t>(middle) * grey.width, grey.width,
                   taps_.data(), reach, grey.width, smoothed_.data() + reach);
  extend(smoothed_, reach, grey.width);
}

void BandPass::find_ground(const formats::Image& grey, int row) {
  const int half = params_.box_px / 2;
  move_down(pixel_row(grey, row + half), pixel_row(grey, row - half - 1), grey.width,
            column_sums_.data());
  divide(column_sums_.data(), grey.width, params_.dark_rises ? -1 : 1,
         params_.dark_rises ? 255 * params_.box_px : 0, params_.box_px,
         column_means_.data() + half);
  extend(column_means_, half, grey.width);
  sum_boxes(column_means_.data(), grey.width, params_.box_px, ground_.data());
  divide(ground_.data(), grey.width, 1, 0, params_.box_px, ground_.data());
}

void BandPass::write_row(int width, float* out) const {
  const int reach = static_cast<int>(taps_.size()) - 1;
  weigh_neighbours(smoothed_.data() + reach, 1, taps_.data(), reach, width, out);
  subtract(ground_.data(), width, params_.dark_rises ? 255.0F : 0.0F,
           params_.dark_rises ? -1.0F : 1.0F, static_cast<float>(params_.min_foreground), out);
}

}  // namespace microswarm::vision
