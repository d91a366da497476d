// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/plant/obstacle_detection.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/swarm/body/swarm_body.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"

namespace microswarm::experiment {

/// Kinematic simulation of a swarm in a world. The camera shows both as they were when the frame
/// was taken, at first as they were at t = 0. Walls do not stop or deflect the swarm;
/// the caller checks for contact.
class KinematicPlant : public Plant {
 public:
  /// Keeps a copy of the world. `trial` selects the random streams of drift and sensor noise.
  KinematicPlant(const Scenario& scenario, World world, std::uint32_t trial = 0);

  Observation observe() override;
  void apply(const Command& command, double dt) override;
  bool set_obstacles(const std::vector<Obstacle>& obstacles) override;
  std::optional<GroundTruth> ground_truth() const override;

 private:
  World world_;
  SensingParams sensing_;
  SwarmBody swarm_;
  Rng drift_;
  Rng noise_;
  Dropouts dropouts_;
  ObstacleDetection obstacles_;
  double now_ = 0;
  double observed_ = 0;               ///< time of the latest observation [s]
  std::vector<PoseStamped> history_;  // covers the age of a frame
};

}  // namespace microswarm::experiment
