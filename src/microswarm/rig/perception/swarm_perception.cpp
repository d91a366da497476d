// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/swarm_perception.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/rig/perception/walls_in_picture.hpp"

namespace microswarm::rig {

namespace {

constexpr double known_size = 0.5;           // of min_radius, to which a known obstacle may shrink
constexpr std::size_t radius_window = 31;    // sightings of which the median radius is taken
constexpr double leaf_tolerance = 6;         // [px] of the outline of a valve's leaf
constexpr double follow_radii = 3;           // way over which a swarm must follow
constexpr std::size_t min_radius_count = 5;  // of sightings before a radius is doubted
constexpr double clear_texture = 2;          // limits of texture, above which it is no smooth swarm
constexpr double part_distance = 2;          // of a part from where the swarm was, in its radii
constexpr double part_size = 0.85;           // maximum of a part, in the swarm's radii
constexpr double area_tolerance = 0.5;       // of the parts' area beside the swarm's

/// Why a search found no swarm.
std::optional<NotFound> not_found(vision::SwarmSight sight) {
  switch (sight) {
    case vision::SwarmSight::found:
      return std::nullopt;
    case vision::SwarmSight::none:
      return NotFound::none;
    case vision::SwarmSight::far:
      return NotFound::far;
    case vision::SwarmSight::several:
      return NotFound::several;
  }
  assert(false);
  return NotFound::none;
}

}  // namespace

vision::SwarmPrior expected_swarm(const SwarmLimits& limits, const PerceptionParams& params,
                                  const vision::CameraScale& scale) {
  vision::SwarmPrior prior;
  if (limits.radius <= 0) return prior;
  const double tolerance = params.radius_tolerance;
  const double least = limits.radius - limits.radius_variation;
  prior.min_radius_px = (1 - tolerance) * least / scale.um_per_px - params.edge;
  prior.max_radius_px = (1 + tolerance) * limits.radius / scale.um_per_px - params.edge;
  return prior;
}

SwarmPerception::SwarmPerception(const PerceptionParams& params, const SwarmLimits& limits,
                                 const Map& map, const Pose2& start, const CameraView& view,
                                 std::span<const Obstacle> obstacles)
    : params_(params),
      scale_(view.scale),
      walls_(walls_in_picture(map, view.scale, view.width, view.height)),
      windows_(walls_),
      valves_(obstacles, leaf_tolerance * view.scale.um_per_px),
      numbers_(params.scene.swarm.jump * view.scale.um_per_px, valves_.count()),
      from_(start.position),
      heading_(start.heading),
      limits_(limits),
      before_px_(scale_.to_picture(start.position)) {}

const Detections& SwarmPerception::process(const formats::Image& picture, double t) {
  detections_.moving.clear();
  const vision::SeenScene scene = find(picture, t);
  numbers_.number(detections_.moving, t);
  valves_.join(detections_.moving);
  const std::optional<vision::Blob>& swarm = scene.swarm.swarm;
  detections_.swarm.reset();
  detections_.parts.clear();
  detections_.not_found = not_found(scene.swarm.sight);
  detections_.commanded = {};
  detections_.commanded_distance = detections_.followed_distance = detections_.across_distance = 0;
  if (tell_split(scene.swarm)) {
    detections_.not_found = NotFound::split;
  } else if (swarm && !is_of_its_size(swarm->radius_px)) {
    detections_.not_found = tell_merger(*swarm, scene) ? NotFound::merged : NotFound::size;
  } else if (swarm) {
    accept(*swarm, scene, t);
  }
  return detections_;
}

/// Searches for the swarm and the bodies around it.
vision::SeenScene SwarmPerception::find(const formats::Image& picture, double t) {
  vision::SceneParams params = search(t);
  if (params_.moving_walls)
    return {.swarm = find_beside_walls(picture, params.swarm), .obstacles = {}};
  params.obstacles.min_radius *= known_size;
  const std::vector<vision::Ring> expected = expected_discs(t);
  vision::SwarmPrior prior = this->prior();
  vision::SeenScene scene = windows_.find(picture, params, prior, expected);
  if (params_.start_anywhere && !found_ && scene.swarm.sight == vision::SwarmSight::far) {
    prior.at_px.reset();
    scene = windows_.find(picture, params, prior, expected);
  }
  for (const vision::SeenObstacle& seen : scene.obstacles)
    if (is_large_or_known(seen, expected))
      detections_.moving.push_back({.shape = seen.shape(scale_)});
  return scene;
}

/// Finds the swarm; everything else is a wall.
vision::SwarmSighting SwarmPerception::find_beside_walls(const formats::Image& picture,
                                                         const vision::SwarmFinderParams& params) {
  const double radius = radii_px_.empty() ? params.look.max_radius : median(radii_px_);
  vision::WallsBesideSwarm found = vision::find_walls_beside(
      picture, params_.walls, walls_, *before_px_, params.jump + 2 * radius, scale_);
  for (Polygon& shape : found.shapes) detections_.moving.push_back({.shape = std::move(shape)});
  return vision::find_swarm(picture, params, before_px_, &found.walls);
}

std::vector<vision::Ring> SwarmPerception::expected_discs(double t) const {
  std::vector<vision::Ring> discs;
  for (const Disc& disc : numbers_.expected_discs(t))
    discs.push_back({scale_.to_picture(disc.centre), disc.radius / scale_.um_per_px});
  return discs;
}

/// Whether a region is an obstacle: a region smaller than the smallest one may be dirt, or a known
/// obstacle that has shrunk.
bool SwarmPerception::is_large_or_known(const vision::SeenObstacle& seen,
                                        const std::vector<vision::Ring>& expected) const {
  const double usual = params_.scene.obstacles.min_radius;
  return seen.blob.radius_px >= usual ||
         std::any_of(expected.begin(), expected.end(), [&](const vision::Ring& disc) {
           return distance(disc.centre_px, seen.blob.centre_px) <= usual;
         });
}

/// Parameters of the search for the swarm: within its reach, and without texture if it had none.
vision::SceneParams SwarmPerception::search(double t) const {
  vision::SceneParams params = params_.scene;
  params.swarm.jump = reach_px(t);
  if (found_ && params.smooth_swarm) {
    params.smooth_swarm = false;
    if (texture_ < clear_texture * params.swarm.look.min_texture) params.swarm.look.min_texture = 0;
  }
  return params;
}

vision::SwarmPrior SwarmPerception::prior() const {
  vision::SwarmPrior prior =
      found_ ? vision::SwarmPrior{} : expected_swarm(limits_, params_, scale_);
  prior.at_px = before_px_;
  if (!radii_px_.empty()) prior.around_px = part_distance * median(radii_px_);
  return prior;
}

void SwarmPerception::accept(const vision::Blob& swarm, const vision::SeenScene& scene, double t) {
  keep_size(swarm);
  const vision::Ring around = *vision::enclosing_circle(swarm.outline_px);
  const Vec2 position = scale_.to_world(around.centre_px);
  measure_following(position, t);
  if (params_.start_anywhere && !found_) from_ = position;
  before_px_ = around.centre_px;
  found_ = t;
  texture_ = swarm.texture;
  beside_ = scene.swarm.others;
  for (const vision::SeenObstacle& seen : scene.obstacles) beside_.push_back(seen.blob);
  tell_heading(position);
  const double radius = std::max(0.0, around.radius_px + params_.edge);
  detections_.swarm = SwarmPose{{position, heading_}, radius * scale_.um_per_px};
}

/// Whether the swarm has split into parts that have its area together. Bodies that were near it
/// before are no parts.
bool SwarmPerception::tell_split(const vision::SwarmSighting& sighting) {
  if (sightings_ < min_radius_count) return false;
  const double usual = median(radii_px_);
  std::vector<vision::Blob> near = sighting.candidates;
  near.insert(near.end(), sighting.others.begin(), sighting.others.end());
  std::erase_if(near, [&](const vision::Blob& blob) {
    return distance(blob.centre_px, *before_px_) > part_distance * usual ||
           std::any_of(beside_.begin(), beside_.end(), [&](const vision::Blob& old) {
             return distance(old.centre_px, blob.centre_px) < 0.5 * old.radius_px;
           });
  });
  double area = 0;
  double largest = 0;
  for (const vision::Blob& blob : near) {
    area += blob.radius_px * blob.radius_px / (usual * usual);
    largest = std::max(largest, blob.radius_px);
  }
  if (near.size() < 2 || largest > part_size * usual || std::abs(area - 1) > area_tolerance)
    return false;
  for (const vision::Blob& blob : near)
    detections_.parts.push_back(blob.radius_px * scale_.um_per_px);
  return true;
}

/// Whether a blob too large for the swarm is the swarm merged with a body that was near it, is no
/// longer seen separately and has the additional area.
bool SwarmPerception::tell_merger(const vision::Blob& whole, const vision::SeenScene& scene) {
  const double usual = median(radii_px_);
  const double grown = whole.radius_px * whole.radius_px - usual * usual;
  if (grown <= 0) return false;
  for (const vision::Blob& old : beside_) {
    const bool is_there = std::any_of(
        scene.obstacles.begin(), scene.obstacles.end(), [&](const vision::SeenObstacle& seen) {
          return distance(seen.blob.centre_px, old.centre_px) < 0.5 * old.radius_px;
        });
    if (is_there || distance(old.centre_px, whole.centre_px) > 2 * whole.radius_px ||
        std::abs(old.radius_px * old.radius_px / grown - 1) > area_tolerance)
      continue;
    detections_.parts = {usual * scale_.um_per_px, old.radius_px * scale_.um_per_px};
    return true;
  }
  return false;
}

void SwarmPerception::commanded(const Command& command, double) { command_ = command; }

double SwarmPerception::follow_distance() const {
  return radii_px_.empty() ? infinity : follow_radii * median(radii_px_) * scale_.um_per_px;
}

/// Maximum distance of the swarm from its last position [px].
double SwarmPerception::reach_px(double t) const {
  const double jump = params_.scene.swarm.jump;
  if (!found_) return jump;
  const double travel = params_.speed_gain * limits_.max_speed * std::max(0.0, t - *found_);
  return std::min(jump, travel / scale_.um_per_px + params_.position_noise);
}

bool SwarmPerception::is_of_its_size(double radius_px) const {
  if (sightings_ < min_radius_count) return true;
  const double usual = median(radii_px_);
  return std::abs(radius_px - usual) <= params_.radius_tolerance * usual;
}

void SwarmPerception::keep_size(const vision::Blob& swarm) {
  if (radii_px_.size() < radius_window)
    radii_px_.push_back(swarm.radius_px);
  else
    radii_px_[sightings_ % radius_window] = swarm.radius_px;
  ++sightings_;
}

void SwarmPerception::measure_following(Vec2 position, double t) {
  if (!found_ || !before_px_) return;
  const Vec2 wanted = displacement(command_, std::max(0.0, t - *found_));
  detections_.commanded = wanted;
  detections_.commanded_distance = norm(wanted);
  if (detections_.commanded_distance <= 0) return;
  const Vec2 seen = position - scale_.to_world(*before_px_);
  detections_.followed_distance = dot(seen, wanted) / detections_.commanded_distance;
  detections_.across_distance = cross(wanted, seen) / detections_.commanded_distance;
}

void SwarmPerception::tell_heading(Vec2 position) {
  if (distance(from_, position) < params_.heading_distance) return;
  heading_ = heading_along(position - from_);
  from_ = position;
}

}  // namespace microswarm::rig
