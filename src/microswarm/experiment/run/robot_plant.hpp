// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// Simulation of robots that are told apart, seen by a camera that shows them as they were
/// `observation_delay` ago. The swarm's pose is their middle, its radius how far they are from that
/// on average (root mean square).
class RobotPlant : public Plant {
 public:
  /// `trial` chooses the streams for places, motion and sensor noise. The scenario has robots.
  RobotPlant(const Scenario& scenario, World world, std::uint32_t trial = 0);

  Observation observe() override;
  void apply(const Command& command, double dt) override;
  std::optional<GroundTruth> ground_truth() const override;

 private:
  struct Moment {
    double t;
    std::vector<Vec2> robots;
  };

  std::vector<Vec2> robots_at(double t) const;

  World world_;
  std::shared_ptr<const Snapshot> walls_;
  SensingParams sensing_;
  Rng motion_;
  Rng noise_;
  double now_ = 0;
  Command command_;
  std::deque<Moment> history_;  // covers the observation delay
  RobotSwarm swarm_;
  std::vector<Vec2> seen_;
};

/// Where the robots of a scenario start: as given, or at random places from which its goal is
/// reached. Throws InputError when there are too few such places.
std::vector<Vec2> robot_starts(const Scenario& scenario, const Map& map, std::uint32_t trial);

}  // namespace microswarm
