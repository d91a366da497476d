// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/wall_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/image/logs.hpp"
#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/vessels/outline.hpp"
#include "microswarm/vision/vessels/region_vessels.hpp"

namespace microswarm {
namespace {

constexpr int tile = 16;  // [px] side of a tile in which the slope of the light is estimated
constexpr int slope_rounds = 15;   // rounds of re-weighting
constexpr double min_off = 1e-4;   // [1/px] lower bound of the residual when re-weighting
constexpr double two_sorts = 0.6;  // minimum separability of walls and channels
constexpr int middle_grey = 100;   // mean grey of the corrected picture

/// Gradient of the logarithm of the light in a tile; x and y from the picture's middle [px].
struct Slope {
  Vec2 at;
  Vec2 rise;  ///< [1/px]
};

/// Gradients of the planes fitted to the tiles of the logarithms.
std::vector<Slope> slopes_of(const cv::Mat& logs) {
  const Vec2 middle{0.5 * (logs.cols - 1), 0.5 * (logs.rows - 1)};
  constexpr double spread = (tile * tile - 1) * tile * tile / 12.0;  // sum of squares of an offset
  std::vector<Slope> slopes;
  for (int top = 0; top + tile <= logs.rows; top += tile)
    for (int left = 0; left + tile <= logs.cols; left += tile) {
      Vec2 sum;
      for (int y = 0; y < tile; ++y)
        for (int x = 0; x < tile; ++x)
          sum += static_cast<double>(logs.at<float>(top + y, left + x)) *
                 Vec2{x - 0.5 * (tile - 1), y - 0.5 * (tile - 1)};
      slopes.push_back(
          {Vec2{left + 0.5 * (tile - 1), top + 0.5 * (tile - 1)} - middle, sum / spread});
    }
  return slopes;
}

/// The surface a x + b y + c x² + d x y + e y² fitted to the slopes by least absolute distances, so
/// tiles with a wall's edge have little influence.
struct Light {
  std::array<double, 5> factor{};

  static std::array<double, 5> along_x(Vec2 p) { return {1, 0, 2 * p.x, p.y, 0}; }
  static std::array<double, 5> along_y(Vec2 p) { return {0, 1, 0, p.x, 2 * p.y}; }
  double product(const std::array<double, 5>& terms) const {
    double sum = 0;
    for (std::size_t i = 0; i < factor.size(); ++i) sum += factor[i] * terms[i];
    return sum;
  }
  double at(double x, double y) const { return product({x, y, x * x, x * y, y * y}); }

  explicit Light(const std::vector<Slope>& slopes) {
    std::vector<double> weight(slopes.size(), 1);
    for (int round = 0; round < slope_rounds; ++round) {
      cv::Mat normal = cv::Mat::zeros(5, 5, CV_64F);
      cv::Mat right = cv::Mat::zeros(5, 1, CV_64F);
      for (std::size_t k = 0; k < slopes.size(); ++k)
        for (const auto& [terms, rise] : {std::pair{along_x(slopes[k].at), slopes[k].rise.x},
                                          {along_y(slopes[k].at), slopes[k].rise.y}})
          for (int i = 0; i < 5; ++i) {
            right.at<double>(i) += weight[k] * terms[i] * rise;
            for (int j = 0; j < 5; ++j) normal.at<double>(i, j) += weight[k] * terms[i] * terms[j];
          }
      cv::Mat solution;
      cv::solve(normal, right, solution, cv::DECOMP_SVD);
      for (int i = 0; i < 5; ++i) factor[i] = solution.at<double>(i);
      for (std::size_t k = 0; k < slopes.size(); ++k) {
        const Vec2 fitted{product(along_x(slopes[k].at)), product(along_y(slopes[k].at))};
        weight[k] = 1 / std::max(min_off, distance(fitted, slopes[k].rise));
      }
    }
  }
};

/// The picture corrected for uneven light, with its mean at the middle grey.
cv::Mat in_even_light(const cv::Mat& grey) {
  cv::Mat even = logs_of(grey, 0);
  const Light light(slopes_of(even));
  for (int y = 0; y < even.rows; ++y)
    for (int x = 0; x < even.cols; ++x)
      even.at<float>(y, x) -=
          static_cast<float>(light.at(x - 0.5 * (even.cols - 1), y - 0.5 * (even.rows - 1)));
  even -= cv::mean(even)[0];
  to_exponentials(even);
  cv::Mat bytes;
  even.convertTo(bytes, CV_8U, middle_grey);
  return bytes;
}

}  // namespace

Image still_background(std::span<const Image> pictures) {
  if (pictures.empty()) throw InputError("background: no pictures");
  Image still = pictures[0];
  for (const Image& p : pictures)
    if (p.width != still.width || p.height != still.height || p.channels != still.channels)
      throw InputError("background: the pictures differ in size");
  std::vector<std::uint8_t> values(pictures.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  for (std::size_t i = 0; i < still.pixels.size(); ++i) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = pictures[k].pixels[i];
    std::nth_element(values.begin(), middle, values.end());
    still.pixels[i] = *middle;
  }
  return still;
}

Mask find_walls(const Image& background, const WallParams& p) {
  if (background.pixels.empty()) return {};
  const Image one = to_grey(background);
  cv::Mat grey = as_mat(one);
  if (p.smooth > 0) {
    cv::Mat smooth;
    cv::GaussianBlur(grey, smooth, {0, 0}, p.smooth);
    grey = smooth;
  }
  const cv::Mat even = in_even_light(grey);
  const TwoGreys sorts = two_greys(even, cv::Mat(grey.size(), CV_8U, cv::Scalar(255)));
  const cv::Mat dark = ~sorts.bright;
  const double step = cv::mean(even, sorts.bright)[0] - cv::mean(even, dark)[0];
  if (sorts.separability < two_sorts || step * cv::mean(grey)[0] < p.min_contrast * middle_grey)
    return {background.width, background.height};
  cv::Mat walls = p.tone == ParticleTone::dark ? dark : sorts.bright;
  walls = without_small_pieces(walls, p.min_area);
  return to_mask(~without_small_pieces(~walls, p.min_area));
}

std::vector<Polygon> walls_in_world(const Mask& walls, const CameraScale& scale, double tolerance) {
  // Outlines have y up from the picture's lower left corner and a pixel size of 1.
  std::vector<Polygon> polygons = outline(walls, 1, tolerance / scale.um_per_px);
  const auto to_picture = [&](std::vector<Vec2>& ring) {
    for (Vec2& p : ring) p = Vec2{p.x - 0.5, walls.height - 0.5 - p.y};
  };
  for (Polygon& polygon : polygons) {
    to_picture(polygon.outer);
    for (auto& hole : polygon.holes) to_picture(hole);
    polygon = polygon_in_world(polygon, scale);
  }
  return polygons;
}

}  // namespace microswarm
