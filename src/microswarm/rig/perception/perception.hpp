// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/rig/params/perception_params.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"

namespace microswarm {

/// What a camera's pictures show.
struct CameraView {
  CameraScale scale;
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
};

/// What an perception makes of a picture.
struct Detections {
  std::optional<SwarmPose> swarm;
  std::vector<Vec2> robots;  ///< where they are told apart; robot i is always the same
  std::vector<Body> moving;  ///< obstacles, known again by their number
  std::string_view trouble;  ///< why there is no swarm: "none", "several"
};

/// Reads a rig's pictures: picture by picture, in world coordinates. Walls are the scenario's map.
class Perception {
 public:
  virtual ~Perception() = default;
  /// The next picture, taken at `t` [s]; a grey one. Valid until the next call.
  virtual const Detections& process(const Image& picture, double t) = 0;
  /// The command that drives the swarm from now on.
  virtual void commanded(const Command& command, double t) { (void)command, (void)t; }
};

/// What a navigator is told of a sight, which outlives the observation, as the world does.
Observation observation_of(const Detections& sight, std::shared_ptr<const Snapshot> world,
                           double now, double seen);

/// The perception that a scenario needs: for one swarm among obstacles, or for robots.
std::unique_ptr<Perception> make_perception(const PerceptionParams& params,
                                            const Scenario& scenario, const Map& map,
                                            std::span<const Vec2> starts, const CameraView& view);

}  // namespace microswarm
