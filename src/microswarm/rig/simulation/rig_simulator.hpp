// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/contracts/plant.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/simulation/field_response.hpp"
#include "microswarm/rig/simulation/microscope.hpp"

namespace microswarm::rig {

/// Simulation of the physical rig: coils, the swarm between them and the microscope. The currents
/// produce the field at the swarm's true position, and this field drives the swarm of the
/// scenario's kinematic plant. The scenario's sensor noise is replaced by that of the pictures.
class RigSimulator {
 public:
  /// `rig`, whose camera must be a simulated one, must outlive it. `trial` selects the random
  /// streams. Throws InputError if rig and scenario do not fit.
  RigSimulator(const experiment::Scenario& scenario, const World& world, const Rig& rig,
               std::uint32_t trial = 0);

  /// Advances by `dt` seconds; at the end the coils carry these currents [A].
  void pass(std::span<const double> currents, double dt);

  /// State captured by the camera.
  struct Shot {
    double now = 0;   ///< [s]
    double seen = 0;  ///< exposure time [s]
    Snapshot world;
    std::optional<SwarmPose> swarm{};
    std::vector<Vec2> robots{};
  };
  Shot capture();
  /// Picture of a shot, valid until the next. Does not access the changing state.
  const formats::Image& render(const Shot& shot) {
    return microscope_.look(shot.world, shot.swarm, shot.robots, shot.seen);
  }

  /// See Plant::set_obstacles.
  bool set_obstacles(const std::vector<Obstacle>& obstacles) {
    return physics_->set_obstacles(obstacles);
  }
  /// Ground truth with the trajectory since `start_trajectory`.
  GroundTruth ground_truth() const;
  void start_trajectory() { trajectory_.clear(); }
  CameraView camera() const {
    return {microscope_.scale(), microscope_.width(), microscope_.height()};
  }
  /// True position of the swarm among the coils [µm].
  Eigen::Vector3d position() const;

 private:
  const Rig& rig_;
  bool robots_;
  double tick_;
  FieldResponse response_;
  std::unique_ptr<Plant> physics_;
  std::shared_ptr<const Map> map_;
  Microscope microscope_;
  Eigen::Vector3d at_;  // position of `actuation_`
  actuation::Actuation actuation_;
  std::vector<PoseStamped> trajectory_;
  Vec2 step_{};         // pending displacement of robots [µm]
  double waiting_ = 0;  // duration of `step_` [s]
};

/// Coil coordinates of a map position: the centre of the map is above the centre of the coils.
Eigen::Vector3d place_among_coils(const actuation::CoilSystem& system, const Map& map,
                                  Vec2 position);
/// The scenario's starts and goals.
std::vector<Vec2> robot_positions(const experiment::Scenario& scenario);
/// Throws InputError if a start or goal of the scenario is outside the workspace of the coils.
void check_workspace(const Rig& rig, const experiment::Scenario& scenario, const Map& map);

}  // namespace microswarm::rig
