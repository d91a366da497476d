// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/swarm_perception.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/rig/perception/walls_in_picture.hpp"

namespace microswarm {

namespace {

constexpr double known_size = 0.5;           // of min_radius, to which a known obstacle may shrink
constexpr std::size_t radius_window = 31;    // sightings of which the median radius is taken
constexpr double follow_radii = 3;           // way over which a swarm must follow
constexpr std::size_t min_radius_count = 5;  // of sightings before a radius is doubted

}  // namespace

SwarmPerception::SwarmPerception(const PerceptionParams& params, double max_speed, const Map& map,
                                 const Pose2& start, const CameraView& view)
    : params_(params),
      scale_(view.scale),
      walls_(walls_in_picture(map, view.scale, view.width, view.height)),
      windows_(walls_),
      numbers_(params.scene.swarm.jump * view.scale.um_per_px),
      from_(start.position),
      heading_(start.heading),
      max_speed_(max_speed),
      before_px_(scale_.to_picture(start.position)) {}

const Detections& SwarmPerception::process(const Image& picture, double t) {
  detections_.moving.clear();
  const SwarmSighting sighting = find(picture, t);
  numbers_.number(detections_.moving, t);
  const std::optional<Blob>& swarm = sighting.swarm;
  detections_.swarm.reset();
  detections_.trouble = enum_name(sighting.sight);
  detections_.commanded_way = detections_.followed_way = 0;
  if (swarm && !is_of_its_size(swarm->radius_px)) {
    detections_.trouble = "size";
  } else if (swarm) {
    const Ring around = *enclosing_circle(swarm->outline_px);
    const Vec2 place = scale_.to_world(around.centre_px);
    measure_following(place, t);
    before_px_ = around.centre_px;
    found_ = t;
    tell_heading(place);
    const double radius = std::max(0.0, around.radius_px + params_.edge);
    detections_.swarm = SwarmPose{{place, heading_}, radius * scale_.um_per_px};
  }
  return detections_;
}

/// Looks for the swarm, and for the bodies around it.
SwarmSighting SwarmPerception::find(const Image& picture, double t) {
  SceneParams params = params_.scene;
  params.swarm.jump = reach_px(t);
  if (params_.moving_walls) return find_beside_walls(picture, params.swarm);
  params.obstacles.min_radius *= known_size;
  const std::vector<Ring> expected = expected_discs(t);
  SeenScene scene = windows_.find(picture, params, before_px_, expected);
  for (const SeenObstacle& seen : scene.obstacles)
    if (is_large_or_known(seen, expected))
      detections_.moving.push_back({.shape = seen.shape(scale_)});
  return std::move(scene.swarm);
}

/// Whatever is not the swarm is a wall then.
SwarmSighting SwarmPerception::find_beside_walls(const Image& picture,
                                                 const SwarmFinderParams& params) {
  const double radius = radii_px_.empty() ? params.look.max_radius : median(radii_px_);
  WallsBesideSwarm found = find_walls_beside(picture, params_.walls, walls_, *before_px_,
                                             params.jump + 2 * radius, scale_);
  for (Polygon& shape : found.shapes) detections_.moving.push_back({.shape = std::move(shape)});
  return find_swarm(picture, params, before_px_, &found.walls);
}

std::vector<Ring> SwarmPerception::expected_discs(double t) const {
  std::vector<Ring> discs;
  for (const Disc& disc : numbers_.expected_discs(t))
    discs.push_back({scale_.to_picture(disc.centre), disc.radius / scale_.um_per_px});
  return discs;
}

/// What is smaller than the smallest obstacle may be dirt, or an obstacle that has shrunk.
bool SwarmPerception::is_large_or_known(const SeenObstacle& seen,
                                        const std::vector<Ring>& expected) const {
  const double usual = params_.scene.obstacles.min_radius;
  return seen.blob.radius_px >= usual ||
         std::any_of(expected.begin(), expected.end(), [&](const Ring& disc) {
           return distance(disc.centre_px, seen.blob.centre_px) <= usual;
         });
}

void SwarmPerception::commanded(const Command& command, double) { command_ = command; }

double SwarmPerception::follow_distance() const {
  return radii_px_.empty() ? infinity : follow_radii * median(radii_px_) * scale_.um_per_px;
}

/// How far from its last position the swarm can be.
double SwarmPerception::reach_px(double t) const {
  const double jump = params_.scene.swarm.jump;
  if (!found_) return jump;
  const double way = params_.speed_gain * max_speed_ * std::max(0.0, t - *found_);
  return std::min(jump, way / scale_.um_per_px + params_.position_noise);
}

bool SwarmPerception::is_of_its_size(double radius_px) {
  if (sightings_ >= min_radius_count) {
    const double usual = median(radii_px_);
    if (std::abs(radius_px - usual) > params_.radius_tolerance * usual) return false;
  }
  if (radii_px_.size() < radius_window)
    radii_px_.push_back(radius_px);
  else
    radii_px_[sightings_ % radius_window] = radius_px;
  ++sightings_;
  return true;
}

void SwarmPerception::measure_following(Vec2 place, double t) {
  if (!found_ || !before_px_) return;
  const Vec2 wanted = displacement(command_, std::max(0.0, t - *found_));
  detections_.commanded_way = norm(wanted);
  if (detections_.commanded_way > 0)
    detections_.followed_way =
        dot(place - scale_.to_world(*before_px_), wanted) / detections_.commanded_way;
}

void SwarmPerception::tell_heading(Vec2 place) {
  if (distance(from_, place) < params_.heading_distance) return;
  heading_ = heading_of(place - from_);
  from_ = place;
}

}  // namespace microswarm
