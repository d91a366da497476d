// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/rig_simulator.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/plant/make_plant.hpp"

namespace microswarm::rig {
namespace {

constexpr double same_place = 20;  // [µm]; the field of a coil is constant over such a distance

/// The scenario of the true swarm: noise is added in the pictures, and the swarm may be faster than
/// the field assumes.
experiment::Scenario true_scenario(experiment::Scenario scenario, const Rig& rig) {
  KeyLocations().require_none(validate(rig, scenario));
  const double faster = std::max(1.0, 1 + simulated_camera(rig).speed_error);
  std::visit([&](auto& swarm) { swarm.max_speed *= faster; }, scenario.swarm);
  if (scenario.robots) scenario.robots->max_speed *= faster;
  scenario.sensing.position_noise = 0;
  scenario.sensing.heading_noise = 0;
  scenario.sensing.missed_share = 0;
  return scenario;
}

FieldResponseParams field_response(const RigParams& rig) {
  const auto* camera = std::get_if<SimulatedCamera>(&rig.camera);
  const SimulatedCamera truth = camera ? *camera : SimulatedCamera();
  const double faster = 1 + truth.speed_error;
  return {.kind = rig.field.kind,
          .frequency = rig.field.frequency,
          .speed_per_pitch = faster * rig.field.speed_per_pitch,
          .length_per_turn = faster * rig.field.length_per_turn,
          .heading_offset = rig.field.heading_offset + truth.direction_error,
          .delay = rig.delay + truth.delay_error,
          .step_out =
              truth.step_out_frequency ? truth.step_out_frequency : rig.field.step_out_frequency};
}

}  // namespace

RigSimulator::RigSimulator(const experiment::Scenario& scenario, const World& world, const Rig& rig,
                           std::uint32_t trial)
    : rig_(rig),
      robots_(scenario.robots.has_value()),
      tick_(scenario.tick),
      response_(field_response(rig.params)),
      physics_(experiment::make_kinematic_plant(true_scenario(scenario, rig), world, trial)),
      map_(world.map),
      microscope_(std::get<SimulatedCamera>(rig.params.camera).microscope, *map_, scenario.seed,
                  trial),
      at_((check_workspace(rig, scenario, *map_), position())),
      actuation_(rig.system.at(at_)) {}

void RigSimulator::pass(std::span<const double> currents, double dt) {
  const Eigen::VectorXd carried = Eigen::Map<const Eigen::VectorXd>(
      currents.data(), static_cast<Eigen::Index>(rig_.system.size()));
  if (const Eigen::Vector3d now = position(); (now - at_).norm() > same_place) {
    at_ = now;
    actuation_ = rig_.system.at(now);
  }
  const Command driven = response_.step(actuation_.total_field(carried), dt);
  if (robots_) {  // robots step once per tick, as their random motion requires
    step_ += displacement(driven, dt);
    waiting_ += dt;
    if (waiting_ < tick_ - 1e-9) return;
    physics_->apply(command_for(step_, waiting_), waiting_);
    step_ = {};
    waiting_ = 0;
    return;
  }
  const double passed = trajectory_.empty() ? 0 : trajectory_.back().t;
  physics_->apply(driven, dt);
  for (const PoseStamped& p :
       physics_->ground_truth()->trajectory.subspan(trajectory_.empty() ? 0 : 1))
    trajectory_.push_back({passed + p.t, p.pose, p.radius});
}

RigSimulator::Shot RigSimulator::capture() {
  const Observation shown = physics_->observe();
  return {.now = shown.now,
          .seen = shown.seen,
          .world = *shown.world,
          .swarm = robots_ ? std::nullopt : shown.swarm,
          .robots = {shown.robots.begin(), shown.robots.end()}};
}

GroundTruth RigSimulator::ground_truth() const {
  GroundTruth ground_truth = *physics_->ground_truth();
  ground_truth.now += waiting_;
  if (!trajectory_.empty()) ground_truth.trajectory = trajectory_;
  return ground_truth;
}

Eigen::Vector3d RigSimulator::position() const {
  return place_among_coils(rig_.system, *map_, physics_->ground_truth()->swarm.pose.position);
}

Eigen::Vector3d place_among_coils(const actuation::CoilSystem& system, const Map& map,
                                  Vec2 position) {
  const Vec2 off = position - map.bounds().centre();
  return system.centre() + Eigen::Vector3d(off.x, off.y, 0);
}

std::vector<Vec2> robot_positions(const experiment::Scenario& scenario) {
  std::vector<Vec2> positions;
  if (scenario.start) positions.push_back(scenario.start->position);
  if (scenario.goal) positions.push_back(*scenario.goal);
  if (scenario.robots) {
    positions.insert(positions.end(), scenario.robots->starts.begin(),
                     scenario.robots->starts.end());
    positions.insert(positions.end(), scenario.robots->goals.begin(), scenario.robots->goals.end());
  }
  return positions;
}

void check_workspace(const Rig& rig, const experiment::Scenario& scenario, const Map& map) {
  for (const Vec2 position : robot_positions(scenario)) {
    const Eigen::Vector3d among = place_among_coils(rig.system, map, position);
    if (!rig.system.in_workspace(among))
      throw rig.keys.error(
          "coils", fmt::format("the place ({:.6g}, {:.6g}) µm of the scenario is at ({:.6g}, "
                               "{:.6g}, {:.6g}) µm among the coils, where their field is not known",
                               position.x, position.y, among.x(), among.y(), among.z()));
  }
}

}  // namespace microswarm::rig
