// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "microswarm/core/error.hpp"
#include "microswarm/vision/ground.hpp"
#include "microswarm/vision/mask_ops.hpp"
#include "microswarm/vision/mat.hpp"
#include "microswarm/vision/outline.hpp"
#include "microswarm/vision/region_vessels.hpp"

namespace microswarm {
namespace {

constexpr double hull_tolerance = 0.5;  // [px]
constexpr int wall_rounds = 4;          // of fitting the light and telling the walls
constexpr double two_sorts = 0.5;       // separability of greys that are walls and channels

cv::Point2f point_of(Vec2 p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

std::vector<cv::Point2f> points_of(const std::vector<Vec2>& ring) {
  std::vector<cv::Point2f> points;
  points.reserve(ring.size());
  for (const Vec2 p : ring) points.push_back(point_of(p));
  return points;
}

bool holds(const Blob& blob, Vec2 p) {
  return cv::pointPolygonTest(points_of(blob.outline_px), point_of(p), false) >= 0;
}

SeenObstacle obstacle_of(Blob blob, double roundness) {
  SeenObstacle obstacle;
  double off = 0;
  for (const Vec2 p : blob.outline_px)
    off = std::max(off, std::abs(distance(p, blob.centre_px) - blob.radius_px));
  obstacle.is_disc = !blob.is_cut && off <= std::max(1.0, roundness * blob.radius_px);
  std::vector<cv::Point2f> hull;
  cv::convexHull(points_of(blob.outline_px), hull);
  std::vector<cv::Point2f> thin;
  cv::approxPolyDP(hull, thin, hull_tolerance, true);
  obstacle.hull_px.reserve(thin.size());
  for (const cv::Point2f p : thin.size() >= 3 ? thin : hull) obstacle.hull_px.push_back({p.x, p.y});
  obstacle.blob = std::move(blob);
  return obstacle;
}

}  // namespace

std::variant<Disc, Polygon> SeenObstacle::shape(const CameraScale& scale) const {
  if (is_disc) return Disc{scale.to_world(blob.centre_px), scale.um_per_px * blob.radius_px};
  return polygon_in_world({.outer = hull_px, .holes = {}}, scale);
}

SeenScene find_scene(const Image& picture, const SceneParams& params, std::optional<Vec2> before_px,
                     const Mask* walls) {
  SeenScene scene{.swarm = find_swarm(picture, params.swarm, before_px, walls), .obstacles = {}};
  const std::optional<Blob>& swarm = scene.swarm.swarm;
  for (Blob& blob : find_blobs(picture, params.obstacles, walls)) {
    if (swarm && (holds(*swarm, blob.centre_px) || holds(blob, swarm->centre_px))) continue;
    scene.obstacles.push_back(obstacle_of(std::move(blob), params.roundness));
  }
  return scene;
}

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
  cv::Mat grey;
  if (p.smooth > 0)
    cv::GaussianBlur(as_mat(one), grey, {0, 0}, p.smooth);
  else
    grey = as_mat(one).clone();
  const cv::Mat all(grey.size(), CV_8U, cv::Scalar(255));
  const bool dark = p.tone == ParticleTone::dark;
  cv::Mat channels = all;
  cv::Mat walls;
  for (int round = 0; round < wall_rounds; ++round) {
    cv::Mat flat;  // the ground at the middle grey
    cv::subtract(grey, ground_of(grey, channels), flat, cv::noArray(), CV_32F);
    flat.convertTo(flat, CV_8U, 1, 128);
    const TwoGreys sorts = two_greys(flat, all);
    walls = dark ? cv::Mat(~sorts.bright) : sorts.bright;
    channels = ~walls;
    const double step = std::abs(cv::mean(flat, walls)[0] - cv::mean(flat, channels)[0]);
    if (cv::countNonZero(walls) == 0 || cv::countNonZero(channels) == 0 || step < p.min_contrast ||
        sorts.separability < two_sorts)
      return {background.width, background.height};
  }
  walls = without_small_pieces(walls, p.min_area);
  return to_mask(~without_small_pieces(~walls, p.min_area));
}

std::vector<Polygon> walls_in_world(const Mask& walls, const CameraScale& scale, double tolerance) {
  // Outlines come with y up from the picture's lower left corner, a pixel wide as 1.
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
