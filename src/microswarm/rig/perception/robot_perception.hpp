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

/// Tracks a known number of robots. Each robot's position is predicted from the command and the
/// walls of the map, and paired with a detected spot. An unpaired spot gets the nearest unpaired
/// robot. Robots left over, which may overlap others, stay at their predicted position if it is
/// dark there and otherwise move to the nearest spot.
class RobotPerception : public Perception {
 public:
  /// The robots start at `starts`; if empty, they are the spots of the first picture.
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
  double seen_ = 0;  // time of the last picture [s]
  Command command_;
  std::vector<Vec2> spots_;  // of the newest picture [µm]
  Assignment assignment_;
  std::vector<AssignmentEdge> edges_;
  std::vector<std::optional<int>> spot_of_;  // of each robot, if it has one
  Detections detections_;
};

}  // namespace microswarm
