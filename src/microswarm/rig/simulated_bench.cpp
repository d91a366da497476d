// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulated_bench.hpp"

#include <fmt/core.h>

#include <cmath>

#include "microswarm/core/error.hpp"
#include "microswarm/experiment/run.hpp"

namespace microswarm {
namespace {

constexpr double same_place = 20;  // [µm]; no coil's field changes over so short a way

Scenario checked_without_noise(Scenario scenario, const RigParams& rig) {
  check(rig, scenario);
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

}  // namespace

SimulatedBench::SimulatedBench(const Scenario& scenario, const World& world, const Rig& rig,
                               std::uint32_t trial)
    : rig_(rig),
      robots_(scenario.robots.has_value()),
      tick_(scenario.tick),
      response_(response_of(rig.params)),
      physics_(make_kinematic_plant(checked_without_noise(scenario, rig.params), world, trial)),
      map_(world.map),
      microscope_(std::get<SimulatedCamera>(rig.params.camera).microscope, *map_, scenario.seed,
                  trial),
      at_(place()),
      actuation_(rig.system.at(at_)) {}

void SimulatedBench::pass(std::span<const double> currents, double dt) {
  const Eigen::VectorXd carried = Eigen::Map<const Eigen::VectorXd>(
      currents.data(), static_cast<Eigen::Index>(rig_.system.size()));
  if (const Eigen::Vector3d now = place(); (now - at_).norm() > same_place) {
    at_ = now;
    actuation_ = rig_.system.at(now);
  }
  const Command driven = response_.step(actuation_.field_of(carried), dt);
  if (robots_) {  // these step once a tick, which is what their randomness is made for
    step_ += displacement(driven, dt);
    waiting_ += dt;
    if (waiting_ < tick_ - 1e-9) return;
    physics_->apply(command_for(step_, waiting_), waiting_);
    step_ = {};
    waiting_ = 0;
    return;
  }
  const double passed = way_.empty() ? 0 : way_.back().t;
  physics_->apply(driven, dt);
  for (const TimedPose& p : physics_->truth()->swept.subspan(way_.empty() ? 0 : 1))
    way_.push_back({passed + p.t, p.pose, p.radius});
}

SimulatedBench::Shot SimulatedBench::shoot() {
  const Observation shown = physics_->observe();
  return {.now = shown.now,
          .seen = shown.seen,
          .world = *shown.world,
          .swarm = robots_ ? std::nullopt : shown.swarm,
          .robots = {shown.robots.begin(), shown.robots.end()}};
}

Truth SimulatedBench::truth() const {
  Truth truth = *physics_->truth();
  truth.now += waiting_;
  if (!way_.empty()) truth.swept = way_;
  return truth;
}

Eigen::Vector3d SimulatedBench::place() const {
  return place_among_coils(rig_.system, *map_, physics_->truth()->swarm.pose.position);
}

Eigen::Vector3d place_among_coils(const CoilSystem& system, const Map& map, Vec2 place) {
  const Vec2 off = place - map.bounds().centre();
  return system.centre() + Eigen::Vector3d(off.x, off.y, 0);
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
