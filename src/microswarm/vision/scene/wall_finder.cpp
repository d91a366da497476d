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

namespace microswarm::vision {
namespace {

constexpr int tile = 16;  // [px] side of a tile in which the slope of the light is estimated
constexpr int slope_rounds = 15;   // rounds of re-weighting
constexpr double min_off = 1e-4;   // [1/px] lower bound of the residual when re-weighting
constexpr double two_sorts = 0.6;  // minimum separability of walls and channels
constexpr int wall_pixel = 2;      // [px] of a pixel in which walls are found beside a swarm
constexpr int soft_edge = 5;       // width of a swarm's edge, on both sides of it
constexpr double outline_tolerance = 0.5;  // of that pixel
constexpr int middle_grey = 100;           // mean grey of the corrected picture

/// Gradient of the logarithm of the light in a tile; x and y from the picture's middle [px].
struct Slope {
  Vec2 at;
  Vec2 rise;  ///< [1/px]
};

/// Gradients of the planes fitted to the tiles of the logarithms.
std::vector<Slope> measure_slopes(const cv::Mat& logs) {
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
  cv::Mat even = log_image(grey, 0);
  const Light light(measure_slopes(even));
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

/// The picture's pixels as walls and channels; empty if there is only one sort.
struct Sorts {
  cv::Mat walls;
  cv::Mat much_darker;  ///< than the darker of the two
};

Sorts classify_pixels(const cv::Mat& picture, const WallParams& p) {
  cv::Mat grey = picture;
  if (p.smooth > 0) {
    cv::Mat smooth;
    cv::GaussianBlur(grey, smooth, {0, 0}, p.smooth);
    grey = smooth;
  }
  const cv::Mat even = in_even_light(grey);
  const TwoGreys sorts = two_greys(even, cv::Mat(grey.size(), CV_8U, cv::Scalar(255)));
  const cv::Mat dark = ~sorts.bright;
  const double dark_grey = cv::mean(even, dark)[0];
  const double step = cv::mean(even, sorts.bright)[0] - dark_grey;
  if (sorts.separability < two_sorts || step * cv::mean(grey)[0] < p.min_contrast * middle_grey)
    return {};
  return {p.tone == ParticleTone::dark ? dark : sorts.bright, even < dark_grey - step / 2};
}

/// Without the pieces within the circle that neither leave it nor touch the picture's edge.
cv::Mat without_islands(const cv::Mat& set, const Disc& circle) {
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(set, labels, stats, centres, 8, CV_32S);
  cv::Mat kept = set.clone();
  const cv::Rect inner(1, 1, set.cols - 2, set.rows - 2);
  for (int k = 1; k < count; ++k) {
    const cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP),
                       stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    const Vec2 middle{box.x + 0.5 * (box.width - 1), box.y + 0.5 * (box.height - 1)};
    const double half = 0.5 * norm(Vec2{1.0 * box.width, 1.0 * box.height});
    if ((box & inner) == box && distance(middle, circle.centre) + half <= circle.radius)
      kept.setTo(0, labels == k);
  }
  return kept;
}

}  // namespace

formats::Image still_background(std::span<const formats::Image> pictures) {
  if (pictures.empty()) throw InputError("background: no pictures");
  formats::Image still = pictures[0];
  for (const formats::Image& p : pictures)
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

formats::Mask find_walls(const formats::Image& background, const WallParams& p) {
  if (background.pixels.empty()) return {};
  const formats::Image one = formats::to_grey(background);
  const Sorts sorts = classify_pixels(as_mat(one), p);
  if (sorts.walls.empty()) return {background.width, background.height};
  const cv::Mat walls = without_small_pieces(sorts.walls, p.min_area);
  return to_mask(~without_small_pieces(~walls, p.min_area));
}

WallsBesideSwarm find_walls_beside(const formats::Image& picture, const WallParams& p,
                                   const formats::Mask& fixed, Vec2 swarm_px, double reach_px,
                                   const CameraScale& scale) {
  if (picture.pixels.empty()) return {};
  const formats::Image one = formats::to_grey(picture);
  cv::Mat grey;
  cv::resize(as_mat(one), grey, {(one.width + 1) / wall_pixel, (one.height + 1) / wall_pixel}, 0, 0,
             cv::INTER_AREA);
  WallParams small = p;
  small.smooth /= wall_pixel;
  small.min_area /= wall_pixel * wall_pixel;
  const Sorts sorts = classify_pixels(grey, small);
  cv::Mat walls = sorts.walls.empty() ? cv::Mat::zeros(grey.size(), CV_8U) : sorts.walls;
  if (!sorts.walls.empty()) {
    cv::Mat dark;
    cv::dilate(sorts.much_darker, dark, cv::Mat::ones(soft_edge, soft_edge, CV_8U));
    walls &= ~dark;
  }
  cv::Mat given;
  cv::resize(to_mat(fixed), given, grey.size(), 0, 0, cv::INTER_NEAREST);
  walls |= given;
  walls = without_islands(walls, {swarm_px / wall_pixel, reach_px / wall_pixel});
  walls = without_small_pieces(walls, small.min_area);
  walls = ~without_small_pieces(~walls, small.min_area);
  CameraScale small_scale = scale;
  small_scale.um_per_px *= wall_pixel;
  small_scale.origin_px = (scale.origin_px - Vec2{0.5, 0.5} * (wall_pixel - 1.0)) / wall_pixel;
  WallsBesideSwarm found;
  found.shapes =
      walls_in_world(to_mask(walls), small_scale, outline_tolerance * small_scale.um_per_px);
  cv::Mat full;
  cv::resize(walls, full, {one.width, one.height}, 0, 0, cv::INTER_NEAREST);
  found.walls = to_mask(full);
  return found;
}

std::vector<Polygon> walls_in_world(const formats::Mask& walls, const CameraScale& scale,
                                    double tolerance) {
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

}  // namespace microswarm::vision
