// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulated_rig.hpp"

#include <fmt/core.h>

#include <cmath>

#include "microswarm/core/error.hpp"
#include "microswarm/experiment/run.hpp"

namespace microswarm {
namespace {

Scenario without_noise(Scenario scenario) {
  scenario.sensing.position_noise = 0;
  scenario.sensing.heading_noise = 0;
  scenario.sensing.missed_share = 0;
  return scenario;
}

FieldResponseParams response_of(const RigParams& rig) {
  const double faster = 1 + std::get<SimulatedCamera>(rig.camera).speed_error;
  return {.kind = rig.field.kind,
          .frequency = rig.field.frequency,
          .speed_per_pitch = faster * rig.field.speed_per_pitch,
          .length_per_turn = faster * rig.field.length_per_turn};
}

std::unique_ptr<CoilDriver> simulated_coils(const RigParams& rig) {
  const auto* given = std::get_if<SimulatedCoils>(&rig.driver);
  const SimulatedCoils coils = given ? *given : SimulatedCoils{};
  return std::make_unique<SimulatedCoilDriver>(coils.channels, coils.full_scale);
}

double heading_of_start(const Scenario& scenario) {
  return scenario.start ? scenario.start->heading : 0;
}

}  // namespace

SimulatedRig::SimulatedRig(const Scenario& scenario, World world, const Rig& rig,
                           std::uint32_t trial, CoilDriver* driver)
    : rig_(rig),
      robots_(scenario.robots.has_value()),
      simulated_coils_(driver ? nullptr : simulated_coils(rig.params)),
      driver_(driver ? *driver : *simulated_coils_),
      controller_(rig.system, rig.params.field, driver_, heading_of_start(scenario)),
      response_(response_of(rig.params)),
      physics_(make_kinematic_plant(without_noise(scenario), world, trial)),
      map_(world.map),
      microscope_(std::get<SimulatedCamera>(rig.params.camera).microscope, *map_, scenario.seed,
                  trial),
      eye_(make_eye(rig.params.eye, scenario, *map_,
                    {physics_->truth()->robots.begin(), physics_->truth()->robots.end()},
                    {microscope_.scale(), microscope_.width(), microscope_.height()})) {
  check(rig.params, scenario);
}

Observation SimulatedRig::observe() {
  const Observation shown = physics_->observe();
  const std::optional<SwarmPose> body = robots_ ? std::nullopt : shown.swarm;
  picture_ = &microscope_.look(*shown.world, body, shown.robots);
  sight_ = &eye_->see(*picture_, shown.seen);
  seen_world_.emplace(map_, shown.seen, sight_->moving);
  Observation seen{.now = shown.now,
                   .seen = shown.seen,
                   .swarm = sight_->swarm,
                   .robots = {},
                   .world = &*seen_world_};
  if (sight_->swarm) seen.robots = sight_->robots;
  return seen;
}

void SimulatedRig::apply(const Command& command, double dt) {
  const auto pieces = static_cast<int>(std::ceil(dt * rig_.params.drive_rate - 1e-9));
  const double piece = dt / pieces;
  controller_.command(command);
  eye_->commanded(command, physics_->truth()->now);
  swept_.clear();
  Vec2 way{};
  for (int i = 0; i < pieces; ++i) {
    const Command driven = field_command(piece);
    if (robots_) {
      way += displacement(driven, piece);
      continue;
    }
    physics_->apply(driven, piece);
    const auto swept = physics_->truth()->swept;
    for (const TimedPose& p : swept.subspan(swept_.empty() ? 0 : 1))
      swept_.push_back({i * piece + p.t, p.pose, p.radius});
  }
  if (robots_) physics_->apply(command_for(way, dt), dt);
}

/// What the field of the coils makes of the swarm after `dt` more seconds.
Command SimulatedRig::field_command(double dt) {
  const Vec2 place = physics_->truth()->swarm.pose.position - map_->bounds().centre();
  const Eigen::Vector3d there = rig_.system.centre() + Eigen::Vector3d(place.x, place.y, 0);
  controller_.aim(there);
  controller_.advance(dt);
  const auto channels = driver_.currents();
  const Eigen::VectorXd currents = Eigen::Map<const Eigen::VectorXd>(
      channels.data(), static_cast<Eigen::Index>(rig_.system.size()));
  return response_.step(controller_.actuation().field_of(currents), dt);
}

std::optional<Truth> SimulatedRig::truth() const {
  auto truth = physics_->truth();
  if (!robots_ && !swept_.empty()) truth->swept = swept_;
  return truth;
}

void check(const RigParams& rig, const Scenario& scenario, const Places& where) {
  const double least_rate = 10 * rig.field.frequency;
  if (rig.drive_rate < least_rate)
    throw InputError(
        fmt::format("the rig's drive_rate_hz is {:.6g}, the field turns {:.6g} times a second and "
                    "needs at least {:.6g}",
                    rig.drive_rate, rig.field.frequency, least_rate));
  const bool rolls = rig.field.kind == FieldKind::rolling;
  const double reach = rolls ? rig.field.length_per_turn * rig.field.frequency
                             : rig.field.speed_per_pitch * rig.field.max_pitch;
  const double wanted =
      scenario.robots ? scenario.robots->max_speed : limits_of(scenario.swarm).max_speed;
  if (wanted > reach * (1 + 1e-9))
    throw where.error({"robots.max_speed_um_per_s", "swarm.max_speed_um_per_s"},
                      fmt::format("the swarm is meant to go {:.6g} µm/s, this rig's field drives "
                                  "it at most {:.6g} µm/s",
                                  wanted, reach));
}

}  // namespace microswarm
