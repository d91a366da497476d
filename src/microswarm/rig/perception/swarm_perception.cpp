// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/swarm_perception.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/rig/perception/walls_in_picture.hpp"

namespace microswarm {

namespace {

constexpr std::size_t radius_window = 31;    // sightings of which the median radius is taken
constexpr double follow_radii = 3;           // way over which a swarm must follow
constexpr std::size_t min_radius_count = 5;  // of sightings before a radius is doubted

}  // namespace

SwarmPerception::SwarmPerception(const PerceptionParams& params, double max_speed, const Map& map,
                                 const Pose2& start, const CameraView& view)
    : params_(params),
      scale_(view.scale),
      walls_(walls_in_picture(map, view.scale, view.width, view.height)),
      numbers_(params.scene.swarm.jump * view.scale.um_per_px),
      from_(start.position),
      heading_(start.heading),
      max_speed_(max_speed),
      before_px_(scale_.to_picture(start.position)) {}

const Detections& SwarmPerception::process(const Image& picture, double t) {
  SceneParams params = params_.scene;
  params.swarm.jump = reach_px(t);
  const SeenScene scene = find_scene(picture, params, before_px_, &walls_);
  const std::optional<Blob>& swarm = scene.swarm.swarm;
  detections_.swarm.reset();
  detections_.trouble = enum_name(scene.swarm.sight);
  detections_.commanded_way = detections_.followed_way = 0;
  if (swarm && !is_of_its_size(swarm->radius_px)) {
    detections_.trouble = "size";
  } else if (swarm) {
    const Vec2 place = scale_.to_world(swarm->centre_px);
    measure_following(place, t);
    before_px_ = swarm->centre_px;
    found_ = t;
    tell_heading(place);
    const double radius = std::max(0.0, swarm->radius_px + params_.edge);
    detections_.swarm = SwarmPose{{place, heading_}, radius * scale_.um_per_px};
  }
  detections_.moving.clear();
  for (const SeenObstacle& seen : scene.obstacles)
    detections_.moving.push_back({.shape = seen.shape(scale_)});
  numbers_.number(detections_.moving, t);
  return detections_;
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
