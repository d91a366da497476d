// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/background.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/maths/magnitudes.hpp"

namespace microswarm::vision {
namespace {

constexpr int tiles_across = 24;   // along the longer side
constexpr int ground_rounds = 12;  // rounds of re-weighting
constexpr double rounding = 0.5;   // [grey] smaller residuals count as zero
constexpr double fit_limit = 4;    // spreads; farther tiles are not background
constexpr int ground_terms = 6;

using Terms = std::array<double, ground_terms>;

/// A quadratic surface; coordinates in units of half the longer side, from the middle.
struct Surface {
  Terms factor{};

  static Terms at(double x, double y) { return {1, x, y, x * x, x * y, y * y}; }
};

struct Tile {
  double x;
  double y;
  double grey;
};

/// Frequency of each grey value.
using Histogram = std::array<int, 256>;

/// In every other row, and every `step`th column; returns the number of pixels.
int count_greys(const cv::Mat& grey, int step, Histogram& count) {
  for (int y = 0; y < grey.rows; y += 2) {
    const auto* row = grey.ptr<std::uint8_t>(y);
    for (int x = 0; x < grey.cols; x += step) ++count[row[x]];
  }
  return ((grey.rows + 1) / 2) * ((grey.cols + step - 1) / step);
}

/// The same of the seen pixels only.
int count_greys(const cv::Mat& grey, const cv::Mat& seen, int step, Histogram& count) {
  int some = 0;
  for (int y = 0; y < grey.rows; y += 2) {
    const auto* row = grey.ptr<std::uint8_t>(y);
    const auto* shown = seen.ptr<std::uint8_t>(y);
    for (int x = 0; x < grey.cols; x += step) {
      if (!shown[x]) continue;
      ++count[row[x]];
      ++some;
    }
  }
  return some;
}

/// Interpolated within the middle grey, as if its pixels were spread uniformly over it.
double median_grey(const Histogram& count, int some) {
  constexpr int group = 16;  // greys that are passed at once
  int sum = 0;
  int value = 0;
  for (; value + group < 256; value += group) {
    const int next = std::accumulate(&count[value], &count[value] + group, 0);
    if (2 * (sum + next) >= some) break;
    sum += next;
  }
  while (2 * (sum + count[value]) < some) sum += count[value++];
  return value - 0.5 + (0.5 * some - sum) / count[value];
}

/// Median of the tile's seen pixels, using every other row and in large tiles every other column;
/// empty if less than a quarter is seen.
std::optional<double> median_grey(const cv::Mat& grey, const cv::Mat& seen) {
  const int step = grey.cols < 24 ? 1 : 2;
  const int all = ((grey.rows + 1) / 2) * ((grey.cols + step - 1) / step);
  Histogram count{};
  const int some =
      seen.empty() ? count_greys(grey, step, count) : count_greys(grey, seen, step, count);
  if (4 * some < all || some == 0) return std::nullopt;
  return median_grey(count, some);
}

std::vector<Tile> list_tiles(const cv::Mat& grey, const cv::Mat& seen, double half) {
  const int side = std::max(2, std::max(grey.cols, grey.rows) / tiles_across);
  const cv::Rect all(0, 0, grey.cols, grey.rows);
  std::vector<Tile> tiles;
  for (int y = 0; y < grey.rows; y += side)
    for (int x = 0; x < grey.cols; x += side) {
      const cv::Rect box = cv::Rect(x, y, side, side) & all;
      const auto value = median_grey(grey(box), seen.empty() ? seen : seen(box));
      if (!value) continue;
      const double cx = box.x + 0.5 * (box.width - 1);
      const double cy = box.y + 0.5 * (box.height - 1);
      tiles.push_back(
          {(cx - 0.5 * (grey.cols - 1)) / half, (cy - 0.5 * (grey.rows - 1)) / half, *value});
    }
  return tiles;
}

/// The terms at a tile, to be added up in whole vectors.
using PaddedTerms = std::array<double, 8>;

std::vector<PaddedTerms> padded_terms(const std::vector<Tile>& tiles) {
  std::vector<PaddedTerms> all(tiles.size());
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    const Terms t = Surface::at(tiles[k].x, tiles[k].y);
    std::copy(t.begin(), t.end(), all[k].begin());
    all[k][ground_terms] = tiles[k].grey;
  }
  return all;
}

/// Normal equations: sums of weight · term · term, and in the column after them of weight · term ·
/// grey.
using Normal = std::array<PaddedTerms, ground_terms>;
static_assert(ground_terms % 2 == 0);

/// Half of the padded terms.
using Lanes = double __attribute__((vector_size(32)));

MICROSWARM_EACH_CPU void add_up(std::span<const PaddedTerms> terms, const double* weight,
                                Normal& sums) {
  for (int i = 0; i < ground_terms; i += 2) {  // two rows, whose sums stay in registers
    Lanes sum[4] = {};
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const double* t = terms[k].data();
      Lanes left;
      Lanes right;
      std::memcpy(&left, t, sizeof left);
      std::memcpy(&right, t + 4, sizeof right);
      const double upper = weight[k] * t[i];
      const double lower = weight[k] * t[i + 1];
      sum[0] += upper * left;
      sum[1] += upper * right;
      sum[2] += lower * left;
      sum[3] += lower * right;
    }
    std::memcpy(sums[i].data(), &sum[0], sizeof sums[i]);
    std::memcpy(sums[i + 1].data(), &sum[2], sizeof sums[i]);
  }
}

Surface fitted(std::span<const PaddedTerms> terms, const std::vector<double>& weight) {
  Normal sums;
  add_up(terms, weight.data(), sums);
  const cv::Mat all(ground_terms, 8, CV_64F, sums.data());
  cv::Mat solution;
  cv::solve(all.colRange(0, ground_terms), all.col(ground_terms), solution, cv::DECOMP_SVD);
  Surface surface;
  for (int i = 0; i < ground_terms; ++i) surface.factor[i] = solution.at<double>(i);
  return surface;
}

/// Distances of the tiles from the surface.
MICROSWARM_EACH_CPU void measure(std::span<const PaddedTerms> terms, const Terms& factor,
                                 double* off) {
  for (std::size_t k = 0; k < terms.size(); ++k) {
    double sum = 0;
    for (int i = 0; i < ground_terms; ++i) sum += factor[i] * terms[k][i];
    off[k] = std::abs(terms[k][ground_terms] - sum);
  }
}

/// Robust fit: least absolute residuals, which tolerate nearly half of the tiles as outliers, then
/// Tukey's biweight.
Surface fitted(const std::vector<Tile>& tiles) {
  const std::vector<PaddedTerms> terms = padded_terms(tiles);
  std::vector<double> weight(tiles.size(), 1);
  std::vector<double> off(tiles.size());
  Surface surface;
  for (int round = 0; round < ground_rounds; ++round) {
    surface = fitted(terms, weight);
    measure(terms, surface.factor, off.data());
    const double limit = fit_limit * std::max(rounding, 1.4826 * median_of_magnitudes(off));
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      const double u = std::min(1.0, off[k] / limit);
      weight[k] = 2 * round < ground_rounds ? 1 / std::max(rounding, off[k])
                                            : (1 - u * u) * (1 - u * u) + 1e-9;
    }
  }
  return surface;
}

/// Writes constant + x (slope + x curve) for each x.
MICROSWARM_EACH_CPU void write_parabola(std::span<const double> across, double constant,
                                        double slope, double curve, float* out) {
  for (std::size_t i = 0; i < across.size(); ++i)
    out[i] = static_cast<float>(constant + across[i] * (slope + across[i] * curve));
}

}  // namespace

GroundSurface::GroundSurface(const cv::Mat& grey, const cv::Mat& seen)
    : half_(0.5 * std::max(grey.cols, grey.rows)),
      middle_x_(0.5 * (grey.cols - 1)),
      middle_y_(0.5 * (grey.rows - 1)) {
  const std::vector<Tile> tiles = list_tiles(grey, seen, half_);
  has_tiles_ = !tiles.empty();
  if (has_tiles_) factor_ = fitted(tiles).factor;
}

cv::Mat GroundSurface::over(const Grid& grid) const {
  if (!has_tiles_) return cv::Mat::zeros(grid.size, CV_32F);
  cv::Mat ground(grid.size, CV_32F);
  const Terms& c = factor_;
  std::vector<double> across(static_cast<std::size_t>(grid.size.width));
  for (int column = 0; column < grid.size.width; ++column)
    across[column] = (grid.x + grid.step * column - middle_x_) / half_;
  for (int row = 0; row < grid.size.height; ++row) {
    const double y = (grid.y + grid.step * row - middle_y_) / half_;
    const double constant = c[0] + y * (c[2] + y * c[5]);
    const double slope = c[1] + y * c[4];
    write_parabola(across, constant, slope, c[3], ground.ptr<float>(row));
  }
  return ground;
}

cv::Mat estimate_background(const cv::Mat& grey, const cv::Mat& seen) {
  return GroundSurface(grey, seen).over({.size = grey.size()});
}

}  // namespace microswarm::vision
