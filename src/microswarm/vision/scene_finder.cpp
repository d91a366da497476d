// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene_finder.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace microswarm {
namespace {

constexpr double hull_tolerance = 0.5;  // [px]
constexpr int soft_edge = 2;            // [px]

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

/// Sets what the blob covers, and its soft edge: an obstacle that it comes near is not taken for a
/// part of it.
void hide(const Blob& blob, Mask& in) {
  std::vector<cv::Point> ring;
  ring.reserve(blob.outline_px.size());
  for (const Vec2 p : blob.outline_px)
    ring.emplace_back(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
  cv::Mat cells(in.height, in.width, CV_8U, in.cells.data());
  cv::fillPoly(cells, std::vector{ring}, 1);
  cv::polylines(cells, std::vector{ring}, true, 1, 2 * soft_edge + 1);
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
  Mask hidden = walls ? *walls : Mask(picture.width, picture.height);
  if (swarm) hide(*swarm, hidden);
  for (Blob& blob : find_blobs(picture, params.obstacles, &hidden)) {
    if (swarm && holds(*swarm, blob.centre_px)) continue;
    scene.obstacles.push_back(obstacle_of(std::move(blob), params.roundness));
  }
  return scene;
}

}  // namespace microswarm
