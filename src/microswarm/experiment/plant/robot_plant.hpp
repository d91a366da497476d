// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/plant/dropouts.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/swarm/robots/robot_swarm.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// Simulation of individually tracked robots. The camera shows them as they were when the frame was
/// taken. The swarm's pose is their centroid, its radius their root-mean-square
/// distance from it.
class RobotPlant : public Plant {
 public:
  /// `trial` selects the random streams of positions, motion and sensor noise. The scenario must
  /// have robots.
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
  Dropouts dropouts_;
  double now_ = 0;
  double observed_ = 0;  ///< time of the latest observation [s]
  Command command_;
  std::deque<Moment> history_;  // covers the age of a frame
  RobotSwarm swarm_;
  std::vector<Vec2> seen_;
};

/// Start positions of a scenario's robots: as given, or random positions from which the goal is
/// reachable. Throws InputError if there are too few such positions.
std::vector<Vec2> robot_starts(const Scenario& scenario, const Map& map, std::uint32_t trial);

}  // namespace microswarm::experiment
