// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/region_vessels.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/vision/image/mask_ops.hpp"

namespace microswarm::vision {
namespace {

constexpr int bad_pixels = 5;   // [px] window of the medians
constexpr double speck = 0.05;  // squares of the wide width
constexpr double wide_region_quantile = 0.8;

std::array<double, 256> histogram(const cv::Mat& grey, const cv::Mat& view) {
  std::array<double, 256> counts{};
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x)
      if (view.at<std::uint8_t>(y, x)) ++counts[grey.at<std::uint8_t>(y, x)];
  return counts;
}

/// Share of the set in one piece, over the mean depth of the set.
double networkness(const cv::Mat& set) {
  const int area = cv::countNonZero(set);
  if (area == 0) return 0;
  const double share = static_cast<double>(cv::countNonZero(largest_piece(set))) / area;
  return share / cv::mean(depth_in(set), set)[0];
}

/// Width of wide channels; in a channel all depths up to half its width are as frequent.
double find_wide_width(const cv::Mat& set) {
  std::vector<float> depths = values_in(depth_in(set), set);
  if (depths.empty()) return 0;
  const double last = static_cast<double>(depths.size() - 1);
  const auto rank = static_cast<std::size_t>(wide_region_quantile * last);
  return 2 / wide_region_quantile * ranked(std::move(depths), rank);
}

}  // namespace

TwoGreys two_greys(const cv::Mat& grey, const cv::Mat& view) {
  cv::Mat clean;
  cv::medianBlur(grey, clean, bad_pixels);
  const auto counts = histogram(clean, view);
  double total = 0, sum = 0, squares = 0;
  for (int g = 0; g < 256; ++g) {
    total += counts[g];
    sum += counts[g] * g;
    squares += counts[g] * g * g;
  }
  TwoGreys result;
  const double variance = total > 0 ? squares / total - (sum / total) * (sum / total) : 0;
  double best = 0, below = 0, below_sum = 0;
  int level = 255;
  for (int g = 0; g < 255; ++g) {
    below += counts[g];
    below_sum += counts[g] * g;
    const double above = total - below;
    if (below == 0 || above == 0) continue;
    const double step = below_sum / below - (sum - below_sum) / above;
    const double between = below * above / (total * total) * step * step;
    if (between > best) best = between, level = g;
  }
  result.bright = (clean > level) & view;
  if (variance > 0) result.separability = best / variance;
  return result;
}

double odds_of_bright_network(const cv::Mat& bright, const cv::Mat& view) {
  const double of_bright = networkness(bright);
  const double of_dark = networkness(view & ~bright);
  if (of_bright == 0 || of_dark == 0) return 1;
  return of_bright / of_dark;
}

FoundVessels region_vessels(const cv::Mat& levels, const cv::Mat& view, bool bright,
                            const VesselParams& params) {
  FoundVessels found;
  found.vessels = bright ? levels > params.wall_level : levels < 1 - params.wall_level;
  found.vessels &= view;
  cv::medianBlur(found.vessels, found.vessels, bad_pixels);
  found.wide_width_px = params.wide_width > 0 ? params.wide_width : find_wide_width(found.vessels);
  const double wide_area = found.wide_width_px * found.wide_width_px;
  fill_holes(found.vessels, speck * wide_area);
  found.vessels = without_small_pieces(found.vessels, speck * params.min_piece * wide_area);
  found.vessels &= view;
  return found;
}

}  // namespace microswarm::vision
