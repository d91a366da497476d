// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/plant/make_plant.hpp"

#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/experiment/plant/robot_plant.hpp"

namespace microswarm::experiment {

std::unique_ptr<Plant> make_kinematic_plant(const Scenario& scenario, const World& world,
                                            std::uint32_t trial) {
  if (scenario.robots) return std::make_unique<RobotPlant>(scenario, world, trial);
  return std::make_unique<KinematicPlant>(scenario, world, trial);
}

}  // namespace microswarm::experiment
