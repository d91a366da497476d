// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/vision/tracking/assignment.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm {

class BackgroundModel;

/// Sees robots whose number is known. Each is looked for where the command should have taken it,
/// held by the walls of the map; those that are not told apart, as robots may lie on one another,
/// are taken to be where they should be, if a spot is there, or else at the nearest spot. No spot
/// is left without a robot as long as another has several.
class RobotPerception : public Perception {
 public:
  /// The robots begin at `starts`; with none, those of the first picture are all there are.
  RobotPerception(const PerceptionParams& params, const RobotSwarmParams& robots, const Map& map,
                  std::span<const Vec2> starts, const CameraView& view);
  ~RobotPerception() override;
  RobotPerception(const RobotPerception&) = delete;
  RobotPerception& operator=(const RobotPerception&) = delete;

  const Detections& process(const Image& picture, double t) override;
  void commanded(const Command& command, double t) override;

 private:
  void find_spots(const Image& picture);
  void expect(double passed);
  void pair(double reach);
  void place_the_unseen();
  void learn_ground();

  CameraScale scale_;
  const Map& map_;
  RobotStepper stepper_;
  ContactRule contact_;
  double max_speed_;  // [µm/s]
  ParticleFinder finder_;
  double diameter_;  // of a robot [µm]
  std::unique_ptr<BackgroundModel> background_;
  double seen_ = 0;  // when the last picture was taken [s]
  Command command_;
  std::vector<Vec2> spots_;  // of the newest picture [µm]
  Assignment assignment_;
  std::vector<AssignmentEdge> edges_;
  std::vector<std::optional<int>> spot_of_;  // of each robot, if it has one
  Detections detections_;
};

}  // namespace microswarm
