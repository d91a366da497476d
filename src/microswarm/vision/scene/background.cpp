// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/background.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/maths/statistics.hpp"

namespace microswarm {
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
  double grey(double x, double y) const {
    const Terms t = at(x, y);
    double sum = 0;
    for (int i = 0; i < ground_terms; ++i) sum += factor[i] * t[i];
    return sum;
  }
};

struct Tile {
  double x;
  double y;
  double grey;
};

/// Median of the tile's seen pixels, using every other row and in large tiles every other column;
/// empty if less than a quarter is seen.
std::optional<double> median_of(const cv::Mat& grey, const cv::Mat& seen) {
  const int step = grey.cols < 24 ? 1 : 2;
  std::array<int, 256> count{};
  int all = 0;
  int some = 0;
  for (int y = 0; y < grey.rows; y += 2) {
    const auto* row = grey.ptr<std::uint8_t>(y);
    const auto* shown = seen.empty() ? nullptr : seen.ptr<std::uint8_t>(y);
    for (int x = 0; x < grey.cols; x += step) {
      ++all;
      if (shown && !shown[x]) continue;
      ++count[row[x]];
      ++some;
    }
  }
  if (4 * some < all || some == 0) return std::nullopt;
  int sum = 0;
  int value = 0;
  while (2 * (sum + count[value]) < some) sum += count[value++];
  // Interpolate within the grey, as if its pixels were spread uniformly over it.
  return value - 0.5 + (0.5 * some - sum) / count[value];
}

std::vector<Tile> tiles_of(const cv::Mat& grey, const cv::Mat& seen, double half) {
  const int side = std::max(2, std::max(grey.cols, grey.rows) / tiles_across);
  const cv::Rect all(0, 0, grey.cols, grey.rows);
  std::vector<Tile> tiles;
  for (int y = 0; y < grey.rows; y += side)
    for (int x = 0; x < grey.cols; x += side) {
      const cv::Rect box = cv::Rect(x, y, side, side) & all;
      const auto value = median_of(grey(box), seen.empty() ? seen : seen(box));
      if (!value) continue;
      const double cx = box.x + 0.5 * (box.width - 1);
      const double cy = box.y + 0.5 * (box.height - 1);
      tiles.push_back(
          {(cx - 0.5 * (grey.cols - 1)) / half, (cy - 0.5 * (grey.rows - 1)) / half, *value});
    }
  return tiles;
}

Surface fitted(const std::vector<Tile>& tiles, const std::vector<double>& weight) {
  std::array<Terms, ground_terms> sums{};
  Terms sums_of_grey{};
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    const Terms t = Surface::at(tiles[k].x, tiles[k].y);
    for (int i = 0; i < ground_terms; ++i) {
      const double weighted = weight[k] * t[i];
      for (int j = 0; j < ground_terms; ++j) sums[i][j] += weighted * t[j];
      sums_of_grey[i] += weighted * tiles[k].grey;
    }
  }
  const cv::Mat normal(ground_terms, ground_terms, CV_64F, sums.data());
  const cv::Mat right(ground_terms, 1, CV_64F, sums_of_grey.data());
  cv::Mat solution;
  cv::solve(normal, right, solution, cv::DECOMP_SVD);
  Surface surface;
  for (int i = 0; i < ground_terms; ++i) surface.factor[i] = solution.at<double>(i);
  return surface;
}

/// Robust fit: least absolute residuals, which tolerate nearly half of the tiles as outliers, then
/// Tukey's biweight.
Surface fitted(const std::vector<Tile>& tiles) {
  std::vector<double> weight(tiles.size(), 1);
  std::vector<double> off(tiles.size());
  Surface surface;
  for (int round = 0; round < ground_rounds; ++round) {
    surface = fitted(tiles, weight);
    for (std::size_t k = 0; k < tiles.size(); ++k)
      off[k] = std::abs(tiles[k].grey - surface.grey(tiles[k].x, tiles[k].y));
    const double limit = fit_limit * std::max(rounding, 1.4826 * median(off));
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
  const std::vector<Tile> tiles = tiles_of(grey, seen, half_);
  has_tiles_ = !tiles.empty();
  if (has_tiles_) factor_ = fitted(tiles).factor;
}

cv::Mat GroundSurface::over(const Grid& grid) const {
  cv::Mat ground = cv::Mat::zeros(grid.size, CV_32F);
  if (!has_tiles_) return ground;
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

cv::Mat ground_of(const cv::Mat& grey, const cv::Mat& seen) {
  return GroundSurface(grey, seen).over({.size = grey.size()});
}

}  // namespace microswarm
