// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/swarm/body/swarm_body.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"

namespace microswarm {

/// Simulation without physics: a swarm in a world, seen by a camera that shows both as they were
/// `observation_delay` ago (at the very beginning: as they were at t = 0). The swarm neither
/// slides nor stops at walls; whoever runs it watches for contact.
class KinematicPlant : public Plant {
 public:
  /// Keeps its own copy of the world. `trial` chooses the streams for drift and for sensor noise.
  KinematicPlant(const Scenario& scenario, World world, std::uint32_t trial = 0);

  Observation observe() override;
  void apply(const Command& command, double dt) override;
  bool set_obstacles(const std::vector<Obstacle>& obstacles) override;
  std::optional<GroundTruth> ground_truth() const override;

 private:
  Snapshot frame_at(double t);

  World world_;
  SensingParams sensing_;
  SwarmBody swarm_;
  Rng drift_;
  Rng noise_;
  Rng obstacle_noise_;
  double now_ = 0;
  std::vector<PoseStamped> history_;  // covers the observation delay
};

}  // namespace microswarm
