// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/two_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/vision/image/along_lines.hpp"
#include "microswarm/vision/image/blur.hpp"
#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/image/total_variation.hpp"

namespace microswarm::vision {
namespace {

constexpr double fit_pixels = 200'000;    // at most, of the picture on which levels are fitted
constexpr int min_pixels = 100;           // of a view that can have two levels
constexpr double rounding_noise = 0.3;    // [grey] noise of whole grey levels
constexpr double normal_median = 0.6745;  // of the absolute value, in standard deviations
constexpr int fit_steps = 60;             // of the denoising of the smaller picture
constexpr int level_rounds = 8;           // of fitting and assigning
constexpr int early_rounds = 3;           // with a light of low degree and an even contrast
constexpr int biased_rounds = 2;          // on the denoised picture
constexpr int early_degree = 2;
constexpr int late_degree = 4;
constexpr double settled_share = 1e-4;   // share of pixels that still change sides
constexpr double min_share = 1e-4;       // of the pixels in either level
constexpr double faintest = 0.25;        // of the mean contrast, locally
constexpr double spot_share = 1.0 / 12;  // of the smaller side: spread of the means of light ...
constexpr double spot_depths = 6;        // ... and at least so many mean depths of the narrow level
constexpr int spot_rounds = 3;
constexpr double local_share = 1.0 / 8;     // the same, before any set is known
constexpr double fine_spread = 6;           // [px] of a wide blur after downsampling
constexpr double structure_blur = 1.5;      // [px] of what the levels leave
constexpr double noisy_structure_blur = 3;  // [px] the same in noise above its contrast
constexpr double clear_share = 0.97;        // explained, and levels of ...
constexpr double clear_of_noise = 20;    // ... times the variance of noise: no other set is tried
constexpr double noise_doubt = 1.3;      // times the variance of noise may be noise
constexpr double steps_per_noise = 160;  // of the final denoising, per noise in contrasts
// A line of a few pixels that is fainter than its noise is nearly as far from 0 as its borders cost
// the denoising; so noise is averaged along lines first.
constexpr double noisy = 0.63;        // noise in contrasts
constexpr double noise_left = 0.125;  // the same, averaged along lines: walls stay within 0.4 px
constexpr double across_lines = 0.7;  // [px] standard deviation across lines ...
constexpr double min_along = 5;       // [px] ... and along them: as the noise requires ...
constexpr double max_along = 12;      // [px] ... up to what bends of channels allow
constexpr double noisy_sample = 0.3;  // the same on the smaller picture
constexpr double sample_along = 6;    // [px]
constexpr double level_depth = 1.5;   // [px] from walls, where levels are measured
constexpr int min_level_steps = 15;
constexpr int max_level_steps = 100;

/// Standard deviation of white noise, from second differences in x and y, which light and edges
/// hardly reach.
double white_noise(const cv::Mat& picture, const cv::Mat& view) {
  constexpr float norm = 6;  // of the nine weights 1 −2 1, −2 4 −2, 1 −2 1
  std::vector<float> sizes;
  for (int y = 1; y + 1 < picture.rows; ++y) {
    const float* const rows[] = {picture.ptr<float>(y - 1), picture.ptr<float>(y),
                                 picture.ptr<float>(y + 1)};
    for (int x = 1; x + 1 < picture.cols; ++x) {
      if (!view.at<std::uint8_t>(y, x)) continue;
      float sum = 0;
      for (int k = 0; k < 3; ++k)
        sum += (k == 1 ? -2.0F : 1.0F) * (rows[k][x - 1] - 2 * rows[k][x] + rows[k][x + 1]);
      sizes.push_back(std::abs(sum));
    }
  }
  if (sizes.empty()) return rounding_noise;
  const std::size_t half = sizes.size() / 2;
  return std::max(rounding_noise, ranked(std::move(sizes), half) / (normal_median * norm));
}

double mean_in(const cv::Mat& values, const cv::Mat& view) { return cv::mean(values, view)[0]; }

cv::Mat above(const cv::Mat& values, double level) {
  cv::Mat set = values > level;
  set.convertTo(set, CV_32F, 1.0 / 255);
  return set;
}

/// Threshold with the greatest variance between its sides (Otsu); nothing if all values are equal.
std::optional<double> otsu(const std::vector<float>& values) {
  constexpr int bins = 256;
  if (values.empty()) return std::nullopt;
  const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
  const double least = *lo;
  const double width = (*hi - least) / bins;
  if (!(width > 0)) return std::nullopt;
  std::array<double, bins> counts{};
  for (const float v : values) ++counts[std::min(bins - 1, static_cast<int>((v - least) / width))];
  double total = 0, sum = 0;
  for (int g = 0; g < bins; ++g) {
    total += counts[g];
    sum += counts[g] * g;
  }
  double below = 0, below_sum = 0, best = -1;
  int level = 0;
  for (int g = 0; g < bins; ++g) {
    below += counts[g];
    below_sum += counts[g] * g;
    if (below == 0 || below == total) continue;
    const double step = below_sum / below - (sum - below_sum) / (total - below);
    const double between = below * (total - below) * step * step;
    if (between > best) best = between, level = g;
  }
  return least + (level + 1) * width;
}

/// The smaller picture on which levels are fitted.
struct LevelSample {
  cv::Mat grey, view, clean;
  double noise = 0;
  double blur = structure_blur;  ///< [px] under which noise is no structure
};

LevelSample sampled(const cv::Mat& grey, const cv::Mat& view, const Stop& stop) {
  LevelSample s;
  grey.convertTo(s.grey, CV_32F);
  s.view = view;
  // Whole pixels are averaged, so white noise stays white.
  const int shrink = cvCeil(std::sqrt(static_cast<double>(grey.total()) / fit_pixels));
  const cv::Size size(grey.cols / std::max(1, shrink), grey.rows / std::max(1, shrink));
  if (shrink > 1 && size.width > 0 && size.height > 0) {
    const cv::Rect whole(0, 0, size.width * shrink, size.height * shrink);
    cv::resize(cv::Mat(s.grey, whole), s.grey, size, 0, 0, cv::INTER_AREA);
    cv::resize(cv::Mat(view, whole), s.view, size, 0, 0, cv::INTER_AREA);
    s.view = s.view > 250;
  }
  s.noise = white_noise(s.grey, s.view);
  s.clean = without_noise(s.grey, s.noise, fit_steps, stop);
  return s;
}

/// Denoises the sample so that lines fainter than its noise stay.
void average_along_lines(LevelSample& s, const Stop& stop) {
  const double left = s.noise / std::sqrt(4 * std::numbers::pi * across_lines * sample_along);
  s.clean =
      without_noise(averaged_along(s.grey, across_lines, sample_along), left, fit_steps, stop);
  s.blur = noisy_structure_blur;
}

struct LevelCandidate {
  LightFit fit;
  cv::Mat set;       ///< of the sample, 0 to 1
  cv::Mat model;     ///< light and levels
  cv::Mat residual;  ///< light beyond the polynomial
  double contrast = 0;
  /// Mean square that light and levels leave of the picture, and the price of the set's border: as
  /// much as in the denoising, so sets that follow noise are dear.
  double left = infinity;
  double explained = 0;
  bool is_clear = false;  ///< nothing else can explain the picture
};

/// Mean of the values in `view` around each pixel, by a bell of this standard deviation, which is
/// wide.
cv::Mat widely_blurred(const cv::Mat& values, const cv::Mat& view, double spread) {
  const int shrink = std::max(1, cvFloor(spread / fine_spread));
  const cv::Size size(std::max(1, values.cols / shrink), std::max(1, values.rows / shrink));
  cv::Mat weight, sum;
  view.convertTo(weight, CV_32F, 1.0 / 255);
  cv::resize(values.mul(weight), sum, size, 0, 0, cv::INTER_AREA);
  cv::resize(weight, weight, size, 0, 0, cv::INTER_AREA);
  sum = blurred(sum, spread / shrink) / cv::max(blurred(weight, spread / shrink), 1e-3);
  cv::resize(sum, sum, values.size(), 0, 0, cv::INTER_LINEAR);
  return sum;
}

/// Spread of the means that follow the light; they must be wider than the narrower level, which
/// they would swallow.
double light_spread(const LevelSample& s, const cv::Mat& set) {
  cv::Mat narrower = set > 0.5;
  narrower &= s.view;
  if (2 * cv::countNonZero(narrower) > cv::countNonZero(s.view)) narrower = s.view & ~narrower;
  const double depth =
      cv::countNonZero(narrower) > 0 ? cv::mean(depth_in(narrower), narrower)[0] : 0;
  return std::max(spot_share * std::min(set.rows, set.cols), spot_depths * depth);
}

/// Mean square of what a model leaves, without fine noise.
double structure_left(const LevelSample& s, const cv::Mat& model) {
  const cv::Mat rest = blurred(s.grey - model, s.blur);
  return mean_in(rest.mul(rest), s.view);
}

/// Finds the share of the variance that levels explain, of what can be neither noise nor light:
/// the same light is fitted without levels.
void explain(const LevelSample& s, LevelCandidate& c) {
  const double noise = s.noise * s.noise / (4 * std::numbers::pi * s.blur * s.blur);
  cv::Mat light = fit_light(s.grey, {}, s.view, late_degree, 0).light.over(s.grey.size());
  light += widely_blurred(s.grey - light, s.view, light_spread(s, c.set));
  const double without = structure_left(s, light) - noise_doubt * noise;
  const double with = structure_left(s, c.model) - noise_doubt * noise;
  if (without > 0) c.explained = std::clamp(1 - with / without, 0.0, 1.0);
  c.is_clear = c.explained > clear_share && without > clear_of_noise * noise;
}

/// Length of the set's border per pixel of the view.
double border_share(const cv::Mat& set, const cv::Mat& view) {
  double steps = 0;
  for (int y = 0; y + 1 < set.rows; ++y)
    for (int x = 0; x + 1 < set.cols; ++x) {
      if (!view.at<std::uint8_t>(y, x)) continue;
      const float here = set.at<float>(y, x);
      steps += (set.at<float>(y, x + 1) != here) + (set.at<float>(y + 1, x) != here);
    }
  return 0.25 * std::numbers::pi * steps / std::max(1, cv::countNonZero(view));
}

/// Fits light and levels and assigns pixels in turn, from a first set on. Light that no polynomial
/// follows, such as a lamp's spot, is the wide mean of what is left: in every round if `spot`, else
/// in the last ones.
LevelCandidate settle(const LevelSample& s, const cv::Mat& first, bool spot) {
  LevelCandidate c;
  c.set = first;
  c.residual = cv::Mat::zeros(first.size(), CV_32F);
  cv::Mat light, contrast;
  int last = level_rounds;
  for (int k = 0; k < last; ++k) {
    const double share = mean_in(c.set, s.view);
    if (share < min_share || share > 1 - min_share) return {};
    const bool early = k < early_rounds;
    c.fit = fit_light((k < biased_rounds ? s.clean : s.grey) - c.residual, c.set, s.view,
                      early ? early_degree : late_degree, early ? 0 : 1);
    light = c.fit.light.over(c.set.size());
    contrast = c.fit.contrast.over(c.set.size());
    c.contrast = mean_in(contrast, s.view);
    if (!(c.contrast > 0)) return {};
    contrast = cv::max(contrast, faintest * c.contrast);
    if (spot || k >= last - spot_rounds)
      c.residual =
          widely_blurred(s.grey - light - contrast.mul(c.set), s.view, light_spread(s, c.set));
    const cv::Mat next = above((s.clean - light - c.residual) / contrast, 0.5);
    const double moved = cv::countNonZero((next != c.set) & s.view);
    c.set = next;
    if (!early && moved < settled_share * static_cast<double>(c.set.total()))
      last = std::min(last, k + 1 + (spot ? 0 : spot_rounds));
  }
  c.model = light + c.residual + contrast.mul(c.set);
  const cv::Mat rest = s.grey - c.model;
  c.left = mean_in(rest.mul(rest), s.view) + 2 * s.noise * c.contrast * border_share(c.set, s.view);
  explain(s, c);
  return c;
}

/// First sets: the upper side of the flattened picture by Otsu's threshold, and by that of either
/// half of its values, since channels may be few pixels.
std::vector<cv::Mat> first_sets(const cv::Mat& flat, const cv::Mat& view) {
  const std::vector<float> all = values_in(flat, view);
  const float middle = ranked(all, all.size() / 2);
  std::vector<float> upper, lower;
  for (const float v : all) (v > middle ? upper : lower).push_back(v);
  std::vector<cv::Mat> sets;
  for (const auto& values : {all, upper, lower})
    if (const std::optional<double> level = otsu(values)) sets.push_back(above(flat, *level));
  return sets;
}

/// `averaged` scaled so that its sides have the levels 0 and 1, which are measured in the middle of
/// the sides: on the smaller picture noise and soft edges have moved them.
cv::Mat with_levels_of(const cv::Mat& unit, const cv::Mat& averaged) {
  const cv::Mat upper = averaged > 0.5;
  const cv::Mat high = depth_in(upper) > level_depth;
  const cv::Mat low = depth_in(~upper) > level_depth;
  if (std::min(cv::countNonZero(high), cv::countNonZero(low)) < min_pixels) return averaged;
  const double zero = mean_in(unit, low);
  const double one = mean_in(unit, high);
  return (averaged - zero) / std::max(faintest, one - zero);
}

/// The best of `best` and what settles from the first sets.
LevelCandidate best_of(const LevelSample& s, LevelCandidate best, int& tried, const Stop& stop) {
  const LightFit first = fit_light(s.clean, {}, s.view, early_degree, 0);
  const double wide = local_share * std::min(s.clean.rows, s.clean.cols);
  for (const bool spot : {false, true}) {
    const cv::Mat light =
        spot ? widely_blurred(s.clean, s.view, wide) : first.light.over(s.clean.size());
    for (const cv::Mat& set : first_sets(s.clean - light, s.view)) {
      if (stop()) return {};
      const LevelCandidate c = settle(s, set, spot);
      ++tried;
      if (c.left < best.left) best = c;
      if (best.is_clear) return best;
    }
  }
  return best;
}

}  // namespace

TwoLevels fit_two_levels(const cv::Mat& grey, const cv::Mat& view, const Stop& stop) {
  LevelSample s = sampled(grey, view, stop);
  if (cv::countNonZero(s.view) < min_pixels || stop()) return {};
  int tried = 0;
  LevelCandidate best = best_of(s, {}, tried, stop);
  if (!stop() && !best.is_clear && s.noise > noisy_sample * best.contrast) {
    average_along_lines(s, stop);
    best = best_of(s, best, tried, stop);
    if (!best.set.empty()) explain(s, best);
  }
  if (best.set.empty()) return {};
  cv::Mat whole;
  grey.convertTo(whole, CV_32F);
  return {best.fit, best.residual, best.contrast, white_noise(whole, view), best.explained, tried};
}

cv::Mat level_picture(const cv::Mat& grey, const TwoLevels& levels, const Stop& stop) {
  if (levels.contrast <= 0) return cv::Mat::zeros(grey.size(), CV_32F);
  cv::Mat unit;
  grey.convertTo(unit, CV_32F);
  cv::Mat residual;
  cv::resize(levels.residual, residual, grey.size(), 0, 0, cv::INTER_LINEAR);
  unit -= levels.fit.light.over(grey.size()) + residual;
  unit /= cv::max(levels.fit.contrast.over(grey.size()), faintest * levels.contrast);
  double noise = levels.noise / levels.contrast;
  if (noise > noisy) {
    const double along = noise * noise / (4 * std::numbers::pi * noise_left * noise_left);
    const cv::Mat averaged =
        averaged_along(unit, across_lines, std::clamp(along, min_along, max_along));
    unit = with_levels_of(unit, averaged);
    noise = noise_left;
  }
  const int steps = std::clamp(cvRound(steps_per_noise * noise), min_level_steps, max_level_steps);
  return without_noise(unit, noise, steps, stop);
}

}  // namespace microswarm::vision
