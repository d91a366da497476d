// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/formats/mask.hpp"
#include "microswarm/rig/eye.hpp"
#include "microswarm/vision/assignment.hpp"
#include "microswarm/vision/particles.hpp"

namespace microswarm {

/// Sees robots whose number is known. Each is looked for near where it was last seen; those that
/// are not told apart, as robots may lie on one another, are taken to be where the nearest spot is.
class RobotEye : public Eye {
 public:
  /// The robots begin at `starts`; with none, those of the first picture are all there are.
  RobotEye(const EyeParams& params, const RobotSwarmParams& robots, const Map& map,
           std::span<const Vec2> starts, const CameraView& view);

  const Sight& see(const Image& picture, double t) override;
  void commanded(const Command& command, double t) override;

 private:
  void hide_walls(const Image& picture);
  void pair(const std::vector<Vec2>& spots, double reach);

  CameraScale scale_;
  Mask walls_;
  Image open_;  // the picture without its walls
  ParticleFinder finder_;
  double max_speed_;  // [µm/s]
  double seen_ = 0;   // when the last picture was taken [s]
  Command command_;
  Assignment assignment_;
  std::vector<AssignmentEdge> edges_;
  Sight sight_;
};

}  // namespace microswarm
