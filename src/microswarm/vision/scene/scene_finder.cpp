// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/scene_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "microswarm/geometry/predicates.hpp"
#include "microswarm/vision/scene/disc_separation.hpp"
#include "microswarm/vision/scene/scene_parts.hpp"

namespace microswarm::vision {
namespace {

constexpr double hull_tolerance = 0.5;  // [px]
constexpr double min_gap = 8;           // [px] larger gaps between outline points are hidden parts
constexpr double join_tolerance = 1.5;  // [px] of the outline of discs that have joined

cv::Point2f to_point(Vec2 p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

std::vector<cv::Point2f> to_points(const std::vector<Vec2>& ring) {
  std::vector<cv::Point2f> points;
  points.reserve(ring.size());
  for (const Vec2 p : ring) points.push_back(to_point(p));
  return points;
}

}  // namespace

formats::Mask hidden_by(const Blob& blob, const formats::Image& picture, const formats::Mask* walls,
                        double margin) {
  formats::Mask hidden = walls ? *walls : formats::Mask(picture.width, picture.height);
  std::vector<cv::Point> ring;
  ring.reserve(blob.outline_px.size());
  for (const Vec2 p : blob.outline_px)
    ring.emplace_back(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
  cv::Mat cells(hidden.height, hidden.width, CV_8U, hidden.cells.data());
  cv::fillPoly(cells, std::vector{ring}, 1);
  cv::polylines(cells, ring, true, 1, 1 + 2 * static_cast<int>(std::ceil(margin)));
  return hidden;
}

namespace {

/// The outline without the parts along hidden regions or the picture's edge.
std::vector<Vec2> own_outline(const Blob& blob, const cv::Size& size, const formats::Mask* hidden) {
  constexpr int margin = 9;  // [px] range over which a hidden region distorts the outline
  std::vector<Vec2> own;
  for (const Vec2 p : blob.outline_px) {
    const cv::Rect all(0, 0, size.width, size.height);
    const cv::Point at(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
    bool is_own = true;
    for (const cv::Point offset : {cv::Point(-margin, 0), {margin, 0}, {0, -margin}, {0, margin}})
      is_own = is_own && all.contains(at + offset) &&
               !(hidden && hidden->at(at.x + offset.x, at.y + offset.y));
    if (is_own) own.push_back(p);
  }
  return own;
}

/// Circle fitted to the visible outline, at least a third of which must be visible.
std::optional<Ring> fit_disc(const Blob& blob, const std::vector<Vec2>& own, double roundness) {
  const auto ring = blob.is_cut ? circle_through(own) : Ring{blob.centre_px, blob.radius_px};
  if (!ring) return std::nullopt;
  double arc = 0;  // of the circle, as the fraction of the outline that is seen
  for (std::size_t i = 1; i < own.size(); ++i)
    if (const double step = distance(own[i - 1], own[i]); step < min_gap) arc += step;
  if (3 * arc < 2 * std::numbers::pi * ring->radius_px) return std::nullopt;
  const double allowed = std::max(1.0, roundness * ring->radius_px);
  const bool is_round = std::all_of(own.begin(), own.end(), [&](Vec2 p) {
    return std::abs(distance(p, ring->centre_px) - ring->radius_px) <= allowed;
  });
  return is_round ? ring : std::nullopt;
}

/// The expected discs whose centres are inside the outline.
std::vector<Ring> discs_within(const Blob& blob, std::span<const Ring> expected) {
  const Polygon inside{.outer = blob.outline_px, .holes = {}};
  std::vector<Ring> within;
  for (const Ring& disc : expected)
    if (locate(inside, disc.centre_px) != Side::outside) within.push_back(disc);
  return within;
}

SeenObstacle with_hull(Blob blob, std::optional<Ring> disc) {
  SeenObstacle obstacle{.disc = disc};
  std::vector<cv::Point2f> hull;
  cv::convexHull(to_points(blob.outline_px), hull);
  std::vector<cv::Point2f> thin;
  cv::approxPolyDP(hull, thin, hull_tolerance, true);
  obstacle.hull_px.reserve(thin.size());
  for (const cv::Point2f p : thin.size() >= 3 ? thin : hull) obstacle.hull_px.push_back({p.x, p.y});
  obstacle.blob = std::move(blob);
  return obstacle;
}

/// Adds the obstacle that the blob shows, or each of the expected discs that have joined in it.
void add_obstacles(Blob blob, const cv::Size& size, const formats::Mask* hidden,
                   const SceneParams& params, std::span<const Ring> expected,
                   std::vector<SeenObstacle>& obstacles) {
  const std::vector<Vec2> own = blob.is_cut ? own_outline(blob, size, hidden) : blob.outline_px;
  std::optional<Ring> disc = fit_disc(blob, own, params.roundness);
  if (!disc) {
    const std::vector<Ring> within = discs_within(blob, expected);
    const DiscSeparation limits{.tolerance = join_tolerance,
                                .bridge = join_tolerance + params.obstacles.gap};
    std::vector<Ring> discs = separated_discs(own, within, limits);
    if (!discs.empty()) {
      for (std::size_t k = 1; k < discs.size(); ++k) obstacles.push_back(with_hull(blob, discs[k]));
      disc = discs[0];
    }
  }
  obstacles.push_back(with_hull(std::move(blob), disc));
}

}  // namespace

bool fits(const Blob& smooth, const SceneParams& params, const SwarmPrior& prior) {
  return !smooth.is_cut && smooth.radius_px >= prior.min_radius_px &&
         smooth.radius_px <= prior.max_radius_px &&
         !(prior.at_px && distance(smooth.centre_px, *prior.at_px) > params.swarm.jump);
}

std::variant<Disc, Polygon> SeenObstacle::shape(const CameraScale& scale) const {
  if (disc) return Disc{scale.to_world(disc->centre_px), scale.um_per_px * disc->radius_px};
  return polygon_in_world({.outer = hull_px, .holes = {}}, scale);
}

SeenScene find_scene(const formats::Image& picture, const SceneParams& params,
                     const SwarmPrior& prior, const formats::Mask* walls,
                     std::span<const Ring> expected) {
  SeenScene scene{.swarm = find_swarm(picture, params.swarm, prior.at_px, walls), .obstacles = {}};
  if (scene.swarm.sight == SwarmSight::none && looks_for_smooth(params))
    scene.swarm = choose_smooth(find_blobs(picture, smooth_look(params), walls), params, prior);
  formats::Mask hidden;
  if (scene.swarm.swarm) {
    hidden = hidden_by(*scene.swarm.swarm, picture, walls, params.swarm.look.gap);
    walls = &hidden;
  }
  scene.obstacles = to_obstacles(find_blobs(picture, params.obstacles, walls),
                                 {picture.width, picture.height}, walls, params, expected);
  return scene;
}

bool looks_for_smooth(const SceneParams& params) {
  return params.smooth_swarm && params.swarm.look.min_texture > 0;
}

BlobParams smooth_look(const SceneParams& params) {
  BlobParams look = params.swarm.look;
  look.min_texture = 0;
  return look;
}

SwarmSighting choose_smooth(std::vector<Blob> blobs, const SceneParams& params,
                            const SwarmPrior& prior) {
  std::erase_if(blobs, [&](const Blob& blob) { return !fits(blob, params, prior); });
  if (blobs.size() != 1) return {};
  return {.sight = SwarmSight::found, .swarm = blobs[0], .candidates = {blobs[0]}, .others = {}};
}

std::vector<SeenObstacle> to_obstacles(std::vector<Blob> blobs, const cv::Size& size,
                                       const formats::Mask* hidden, const SceneParams& params,
                                       std::span<const Ring> expected) {
  std::vector<SeenObstacle> obstacles;
  for (Blob& blob : blobs)
    add_obstacles(std::move(blob), size, hidden, params, expected, obstacles);
  return obstacles;
}

}  // namespace microswarm::vision
