// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "microswarm/core/matching/assignment.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm::rig {

class BackgroundModel;

/// Tracks a known number of robots. Each robot's position is predicted from the command and the
/// walls of the map, and paired with a detected spot. An unpaired spot gets the nearest unpaired
/// robot that can have reached it. A remaining robot joins a pile: it stays at its predicted
/// position if it is dark there, or moves to a spot within its reach. Without one it is unseen and
/// keeps its expected position; a robot that was unseen for a while needs a separate spot to be
/// seen again. There is no swarm if too few robots are seen.
class RobotPerception : public Perception {
 public:
  /// The robots start at `starts`; if empty, they are the spots of the first picture.
  RobotPerception(const PerceptionParams& params, const RobotSwarmParams& robots, const Map& map,
                  std::span<const Vec2> starts, const CameraView& view);
  ~RobotPerception() override;
  RobotPerception(const RobotPerception&) = delete;
  RobotPerception& operator=(const RobotPerception&) = delete;

  const Detections& process(const formats::Image& picture, double t) override;
  void commanded(const Command& command, double t) override;
  double follow_distance() const override { return follow_diameters * diameter_; }

 private:
  static constexpr double follow_diameters = 10;

  void find_spots(const formats::Image& picture);
  void expect(double passed);
  void pair(double reach);
  void place_the_unpaired(double t, double reach);
  double robot_reach(std::size_t robot, double t) const;
  void measure_following();
  void learn_ground();

  vision::CameraScale scale_;
  const Map& map_;
  RobotStepper stepper_;
  ContactRule contact_;
  double max_speed_;  // [µm/s]
  vision::ParticleFinder finder_;
  double diameter_;  // of a robot [µm]
  double min_seen_;  // share of the robots
  std::unique_ptr<BackgroundModel> background_;
  double seen_ = 0;  // time of the last picture [s]
  Command command_;
  std::vector<Vec2> spots_;  // of the newest picture [µm]
  Assignment assignment_;
  std::vector<AssignmentEdge> edges_;
  std::vector<std::optional<int>> spot_of_;  // of each robot, if it has one
  std::vector<double> seen_at_;              // when each robot was last seen [s]
  std::vector<Vec2> before_;                 // positions in the picture before
  std::vector<Vec2> expected_;               // positions expected in this one
  Detections detections_;
};

}  // namespace microswarm::rig
