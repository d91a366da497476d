// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/simulated_rig.hpp"

#include <cmath>

#include "microswarm/navigation/make.hpp"

namespace microswarm {

SimulatedRig::SimulatedRig(const Scenario& scenario, const World& world, const Rig& rig,
                           std::uint32_t trial, CoilDriver* driver)
    : rig_(rig),
      simulated_coils_(driver ? nullptr : simulated_coils(rig.params)),
      driver_(driver ? *driver : *simulated_coils_),
      controller_(rig.system, rig.params.field, driver_,
                  scenario.start ? scenario.start->heading : 0),
      bench_(scenario, world, rig, trial),
      map_(world.map),
      eye_(make_eye(rig.params.eye, scenario, *map_, bench_.truth().robots, bench_.camera())) {}

Observation SimulatedRig::observe() {
  const SimulatedBench::Shot shot = bench_.shoot();
  picture_ = &bench_.develop(shot);
  sight_ = &eye_->see(*picture_, shot.seen);
  return observation_of(*sight_, std::make_shared<const Snapshot>(map_, shot.seen, sight_->moving),
                        shot.now, shot.seen);
}

void SimulatedRig::apply(const Command& command, double dt) {
  const auto pieces = static_cast<int>(std::ceil(dt * rig_.params.drive_rate - 1e-9));
  const double piece = dt / pieces;
  controller_.command(command);
  eye_->commanded(command, bench_.truth().now);
  bench_.begin_way();
  for (int i = 0; i < pieces; ++i) {
    controller_.aim(bench_.place());
    controller_.advance(piece);
    bench_.pass(driver_.currents(), piece);
  }
}

RunResult rehearse(const Scenario& scenario, const World& world, const Rig& rig,
                   std::uint32_t trial, std::span<RunListener* const> listeners, const Stop& stop) {
  SimulatedRig plant(scenario, world, rig, trial);
  const auto navigator = make_navigator(scenario.navigator, task_of(scenario),
                                        Rng(scenario.seed, Purpose::planner, trial));
  return run(scenario, plant, *navigator, listeners, stop);
}

std::unique_ptr<CoilDriver> simulated_coils(const RigParams& rig) {
  const auto* given = std::get_if<SimulatedCoils>(&rig.driver);
  const SimulatedCoils coils = given ? *given : SimulatedCoils{};
  return std::make_unique<SimulatedCoilDriver>(coils.channels, coils.full_scale);
}

}  // namespace microswarm
