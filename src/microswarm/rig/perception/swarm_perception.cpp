// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/swarm_perception.hpp"

#include <algorithm>

#include "microswarm/rig/perception/walls_in_picture.hpp"

namespace microswarm {

SwarmPerception::SwarmPerception(const PerceptionParams& params, const Map& map, const Pose2& start,
                                 const CameraView& view)
    : params_(params),
      scale_(view.scale),
      walls_(walls_in_picture(map, view.scale, view.width, view.height)),
      numbers_(params.scene.swarm.jump * view.scale.um_per_px),
      from_(start.position),
      heading_(start.heading),
      before_px_(scale_.to_picture(start.position)) {}

const Detections& SwarmPerception::process(const Image& picture, double t) {
  const SeenScene scene = find_scene(picture, params_.scene, before_px_, &walls_);
  const std::optional<Blob>& swarm = scene.swarm.swarm;
  detections_.swarm.reset();
  detections_.trouble = enum_name(scene.swarm.sight);
  if (swarm) {
    before_px_ = swarm->centre_px;
    const Vec2 place = scale_.to_world(swarm->centre_px);
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

void SwarmPerception::tell_heading(Vec2 place) {
  if (distance(from_, place) < params_.heading_distance) return;
  heading_ = heading_of(place - from_);
  from_ = place;
}

}  // namespace microswarm
