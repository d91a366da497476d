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

namespace microswarm {

/// What stands on a bench, simulated: coils, the swarm between them and the microscope above. The
/// currents make the field where the swarm truly is, and that field drives the swarm of the
/// scenario's kinematic plant. The scenario's sensor noise is left out: pictures have their own.
class RigSimulator {
 public:
  /// The rig, whose camera is a simulated one, outlives it. `trial` chooses the streams. Throws
  /// InputError when rig and scenario do not go together.
  RigSimulator(const Scenario& scenario, const World& world, const Rig& rig,
               std::uint32_t trial = 0);

  /// Lets `dt` seconds pass after which the coils carry these currents [A].
  void pass(std::span<const double> currents, double dt);

  /// What the camera is shown.
  struct Shot {
    double now = 0;   ///< [s]
    double seen = 0;  ///< when it was so [s]
    Snapshot world;
    std::optional<SwarmPose> swarm;
    std::vector<Vec2> robots;
  };
  Shot capture();
  /// Its picture, valid until the next; knows nothing of what passes meanwhile.
  const Image& render(const Shot& shot) {
    return microscope_.look(shot.world, shot.swarm, shot.robots);
  }

  /// As Plant::set_obstacles.
  bool set_obstacles(const std::vector<Obstacle>& obstacles) {
    return physics_->set_obstacles(obstacles);
  }
  /// The ground_truth; its way is that since `start_trajectory`.
  GroundTruth ground_truth() const;
  void start_trajectory() { way_.clear(); }
  CameraView camera() const {
    return {microscope_.scale(), microscope_.width(), microscope_.height()};
  }
  /// Where the swarm truly is among the coils [µm].
  Eigen::Vector3d place() const;

 private:
  const Rig& rig_;
  bool robots_;
  double tick_;
  FieldResponse response_;
  std::unique_ptr<Plant> physics_;
  std::shared_ptr<const Map> map_;
  Microscope microscope_;
  Eigen::Vector3d at_;  // where `actuation_` holds
  Actuation actuation_;
  std::vector<PoseStamped> way_;
  Vec2 step_{};         // of robots, not made yet [µm]
  double waiting_ = 0;  // for how long [s]
};

/// Where a place of the map is among a rig's coils: the middle of the map is above their centre.
Eigen::Vector3d place_among_coils(const CoilSystem& system, const Map& map, Vec2 place);
/// The scenario's starts and goals.
std::vector<Vec2> places_of(const Scenario& scenario);
/// Throws InputError when the scenario's starts or goals are where nobody knows the coils' field.
void check_workspace(const Rig& rig, const Scenario& scenario, const Map& map);

}  // namespace microswarm
