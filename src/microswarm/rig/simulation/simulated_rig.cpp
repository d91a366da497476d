// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/simulated_rig.hpp"

#include <cmath>
#include <utility>

namespace microswarm::rig {

SimulatedRig::SimulatedRig(const experiment::Scenario& scenario, const World& world, Rig rig,
                           std::uint32_t trial, actuation::CoilDriver* driver)
    : rig_(std::move(rig)),
      simulated_coils_(driver ? nullptr : simulated_coils(rig_)),
      driver_(driver ? *driver : *simulated_coils_),
      controller_(rig_.system, rig_.params.field, driver_,
                  scenario.start ? scenario.start->heading : 0),
      simulator_(scenario, world, rig_, trial),
      map_(world.map),
      perception_(make_perception(rig_.params.perception, scenario, *map_,
                                  simulator_.ground_truth().robots, simulator_.camera())) {}

Observation SimulatedRig::observe() {
  const RigSimulator::Shot shot = simulator_.capture();
  picture_ = &simulator_.render(shot);
  detections_ = &perception_->process(*picture_, shot.seen);
  return to_observation(*detections_,
                        std::make_shared<const Snapshot>(map_, shot.seen, detections_->moving),
                        shot.now, shot.seen);
}

void SimulatedRig::apply(const Command& command, double dt) {
  const auto pieces = static_cast<int>(std::ceil(dt * rig_.params.drive_rate - 1e-9));
  const double piece = dt / pieces;
  controller_.command(command);
  perception_->commanded(command, simulator_.ground_truth().now);
  simulator_.start_trajectory();
  for (int i = 0; i < pieces; ++i) {
    controller_.aim(simulator_.position());
    controller_.advance(piece);
    simulator_.pass(driver_.report().currents, piece);
  }
}

std::unique_ptr<actuation::CoilDriver> simulated_coils(const Rig& rig) {
  return std::make_unique<actuation::SimulatedCoilDriver>(
      channel_count(rig.params, rig.system), driver_full_scale(rig.params), coil_input(rig.params));
}

}  // namespace microswarm::rig
