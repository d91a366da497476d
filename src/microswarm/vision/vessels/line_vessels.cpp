// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/line_vessels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/vision/image/blur.hpp"
#include "microswarm/vision/image/logs.hpp"
#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/vessels/bridges.hpp"
#include "microswarm/vision/vessels/line_filter.hpp"
#include "microswarm/vision/vessels/walls.hpp"

namespace microswarm::vision {
namespace {

constexpr double working_radius = 4.3;      // [px] of the wide vessels; optimal for the filter
constexpr double first_diameter = 900;      // [px] of the view in the first measurement of widths
constexpr double max_diameter = 2000;       // [px] maximum of the view at working resolution
constexpr double tone_diameter = 450;       // [px] of the view on which their tone is measured
constexpr double tone_radius = 3;           // [px] of wide vessels there
constexpr double tail_quantile = 0.97;      // of the line score
constexpr double wide_line_quantile = 0.8;  // quantile of the depths of vessel pixels ...
constexpr double wide_factor = 1.35;        // ... times this is the wide radius
constexpr double first_blur = 2.2;          // [px] widening of vessels in the first measurement
constexpr double soft_rim = 0.01;           // of the view's diameter
constexpr double dark_noise = 15;           // [grey levels] below which absorbance is unreliable
constexpr double opening = 8;               // diameter of the opening's disc in wide radii
constexpr double min_disc = 10;             // [px] minimum diameter of that disc after downsampling
constexpr double clear_quantile = 0.99;     // of the line score, which clear lines reach ...
// ... in spreads above the median: on a clean background the interquartile range is tiny, and the
// flanks of the filter's answer would be lines.
constexpr double max_clear_spreads = 10;
constexpr double sure_margin = 0.5;  // spreads above the threshold
constexpr double small_piece = 0.2;  // relative to the minimum piece: too small to be bridged
constexpr double reflex = 0.3;       // squares of the wide width: holes left by light reflexes

/// The picture at working resolution.
struct Working {
  cv::Mat absorbance;  ///< bright where vessels are
  cv::Mat view;
  double scale = 1;
};

struct Lines {
  cv::Mat fitted;  ///< with walls fitted to the picture
  cv::Mat sure;    ///< almost certainly vessel, so fitted walls do not cut it
  cv::Mat score;   ///< in spreads above the median
};

bool is_whole(const cv::Mat& view) {
  return cv::countNonZero(view) == static_cast<int>(view.total());
}

double view_diameter(const cv::Mat& view) {
  return 2 * std::sqrt(cv::countNonZero(view) / std::numbers::pi);
}

/// Replaces every pixel outside `view` by the nearest one inside, so vessels continue.
void continue_outside(cv::Mat& picture, const cv::Mat& view) {
  if (is_whole(view) || cv::countNonZero(view) == 0) return;
  cv::Mat distance, labels;
  cv::distanceTransform(~view, distance, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<float> values(view.total() + 1, 0.0F);
  for (int y = 0; y < view.rows; ++y)
    for (int x = 0; x < view.cols; ++x)
      if (view.at<std::uint8_t>(y, x)) values[labels.at<int>(y, x)] = picture.at<float>(y, x);
  for (int y = 0; y < view.rows; ++y)
    for (int x = 0; x < view.cols; ++x)
      if (!view.at<std::uint8_t>(y, x)) picture.at<float>(y, x) = values[labels.at<int>(y, x)];
}

cv::Size shrunk(cv::Size size, double scale) {
  return {std::max(1, cvRound(size.width * scale)), std::max(1, cvRound(size.height * scale))};
}

/// Top-hat transform: the picture minus its grey opening by a disc wider than any vessel. A step
/// has no response on either side, so the bright optic disc gets no rim.
cv::Mat standing_out(const cv::Mat& picture, double wide_radius) {
  const double diameter = opening * wide_radius;
  const int shrink = std::max(1, cvFloor(diameter / min_disc));
  cv::Mat ground = blurred(picture, std::max(0.5, shrink / 2.0));
  if (shrink > 1)
    cv::resize(ground, ground, shrunk(picture.size(), 1.0 / shrink), 0, 0, cv::INTER_AREA);
  const int side = 2 * cvRound(diameter / shrink / 2) + 1;
  cv::morphologyEx(ground, ground, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
  ground = blurred(ground, 1);
  if (shrink > 1) cv::resize(ground, ground, picture.size(), 0, 0, cv::INTER_LINEAR);
  return picture - ground;
}

Working at_scale(const cv::Mat& grey, const cv::Mat& view, double scale, double wide_radius,
                 bool bright) {
  Working w{grey, view, scale};
  if (scale < 1) {
    const cv::Size size = shrunk(grey.size(), scale);
    cv::resize(grey, w.absorbance, size, 0, 0, cv::INTER_AREA);
    cv::resize(view, w.view, size, 0, 0, cv::INTER_AREA);
    w.view = w.view > 250;
  }
  w.absorbance = log_image(w.absorbance, dark_noise);
  if (!bright) w.absorbance = -w.absorbance;
  if (!is_whole(w.view))
    continue_outside(w.absorbance, depth_in(w.view) > soft_rim * view_diameter(w.view));
  w.absorbance = standing_out(w.absorbance, wide_radius);
  return w;
}

/// Quantile of the values inside `where`; 0 if it is empty.
double quantile(const cv::Mat& values, const cv::Mat& where, double q) {
  std::vector<float> list = values_in(values, where);
  if (list.empty()) return 0;
  const double last = static_cast<double>(list.size() - 1);
  return ranked(std::move(list), static_cast<std::size_t>(std::lround(q * last)));
}

/// Hysteresis threshold on the line score, then fitted walls.
Lines find_lines(const Working& w, double wide_radius, const VesselParams& params) {
  cv::Mat score = line_score(w.absorbance, w.view, {.wide_radius = wide_radius});
  const double median = quantile(score, w.view, 0.5);
  const double most = (quantile(score, w.view, clear_quantile) - median) / max_clear_spreads;
  const double spread =
      std::max(most, quantile(score, w.view, 0.75) - quantile(score, w.view, 0.25));
  if (spread <= 0) {
    const cv::Mat none = cv::Mat::zeros(w.view.size(), CV_8U);
    return {none, none, score};
  }
  score = (score - median) / spread;
  const cv::Mat rough = pieces_with((score > params.threshold) & w.view,
                                    (score > std::max(params.threshold, params.seed_threshold)));
  const cv::Mat fitted = fitted_walls(w.absorbance, rough, w.view, wide_radius, params.wall_level);
  return {fitted, rough & (score > params.threshold + sure_margin), score};
}

/// Distance of the largest line scores from the median, in interquartile ranges.
double tail(const cv::Mat& score, const cv::Mat& view) {
  const double spread = quantile(score, view, 0.75) - quantile(score, view, 0.25);
  return spread > 0 ? (quantile(score, view, tail_quantile) - quantile(score, view, 0.5)) / spread
                    : 0;
}

/// Radius of the wide vessels in pixels of the picture, from a first segmentation at low
/// resolution.
double measured_radius(const cv::Mat& grey, const cv::Mat& view, bool bright,
                       const VesselParams& params) {
  const double scale = std::min(1.0, first_diameter / view_diameter(view));
  const Working w = at_scale(grey, view, scale, working_radius, bright);
  const cv::Mat vessels = find_lines(w, working_radius, params).fitted;
  const double seen = quantile(depth_in(vessels), vessels, wide_line_quantile);
  if (seen == 0) return working_radius / scale;
  return wide_factor * std::sqrt(std::max(1.0, seen * seen - first_blur * first_blur)) / scale;
}

}  // namespace

double odds_of_bright_lines(const cv::Mat& grey, const cv::Mat& view) {
  const double scale = std::min(1.0, tone_diameter / view_diameter(view));
  double tails[2] = {};
  for (const bool bright : {false, true}) {
    const Working w = at_scale(grey, view, scale, tone_radius, bright);
    tails[bright] = tail(line_score(w.absorbance, w.view, {.wide_radius = tone_radius}), w.view);
  }
  return tails[0] > 0 && tails[1] > 0 ? tails[1] / tails[0] : 1;
}

FoundVessels line_vessels(const cv::Mat& grey, const cv::Mat& view, bool bright,
                          const VesselParams& params, const Stop& stop) {
  const double radius =
      params.wide_width > 0 ? params.wide_width / 2 : measured_radius(grey, view, bright, params);
  FoundVessels found{.vessels = cv::Mat::zeros(view.size(), CV_8U)};
  found.wide_width_px = 2 * radius;
  found.scale = std::min({1.0, max_diameter / view_diameter(view), working_radius / radius});
  const double wide_radius = radius * found.scale;
  const double wide_area = 4 * wide_radius * wide_radius;

  if (stop()) return found;
  const Working w = at_scale(grey, view, found.scale, wide_radius, bright);
  if (stop()) return found;
  const Lines lines = find_lines(w, wide_radius, params);
  if (stop()) return found;
  found.vessels =
      without_small_pieces(lines.fitted | lines.sure, small_piece * params.min_piece * wide_area);
  fill_holes(found.vessels, reflex * wide_area);
  if (params.gap > 0) {
    const cv::Mat cost = cv::max(0.3, 1 - lines.score / std::max(0.1, params.threshold)) + 0.2;
    found.bridges = bridge_gaps(found.vessels, cost, params.gap * 2 * wide_radius);
  }
  found.vessels = without_small_pieces(found.vessels, params.min_piece * wide_area);
  if (found.scale < 1) {
    cv::resize(found.vessels, found.vessels, view.size(), 0, 0, cv::INTER_LINEAR);
    found.vessels = found.vessels > 127;
  }
  found.vessels &= view;
  return found;
}

}  // namespace microswarm::vision
