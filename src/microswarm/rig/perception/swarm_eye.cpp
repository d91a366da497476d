// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/perception/swarm_eye.hpp"

#include <algorithm>

#include "microswarm/rig/perception/walls_in_picture.hpp"

namespace microswarm {

SwarmEye::SwarmEye(const EyeParams& params, const Map& map, const Pose2& start,
                   const CameraView& view)
    : params_(params),
      scale_(view.scale),
      walls_(walls_in_picture(map, view.scale, view.width, view.height)),
      numbers_(params.scene.swarm.jump * view.scale.um_per_px),
      from_(start.position),
      heading_(start.heading),
      before_px_(scale_.to_picture(start.position)) {}

const Sight& SwarmEye::see(const Image& picture, double t) {
  const SeenScene scene = find_scene(picture, params_.scene, before_px_, &walls_);
  const std::optional<Blob>& swarm = scene.swarm.swarm;
  sight_.swarm.reset();
  sight_.trouble = enum_name(scene.swarm.sight);
  if (swarm) {
    before_px_ = swarm->centre_px;
    const Vec2 place = scale_.to_world(swarm->centre_px);
    tell_heading(place);
    const double radius = std::max(0.0, swarm->radius_px + params_.edge);
    sight_.swarm = SwarmPose{{place, heading_}, radius * scale_.um_per_px};
  }
  sight_.moving.clear();
  for (const SeenObstacle& seen : scene.obstacles)
    sight_.moving.push_back({.shape = seen.shape(scale_)});
  numbers_.number(sight_.moving, t);
  return sight_;
}

void SwarmEye::tell_heading(Vec2 place) {
  if (distance(from_, place) < params_.heading_way) return;
  heading_ = heading_of(place - from_);
  from_ = place;
}

}  // namespace microswarm
