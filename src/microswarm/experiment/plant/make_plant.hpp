// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::experiment {

/// Creates the kinematic simulation of a scenario: one swarm, or individual robots. `trial` selects
/// the random streams.
std::unique_ptr<Plant> make_kinematic_plant(const Scenario& scenario, const World& world,
                                            std::uint32_t trial = 0);

}  // namespace microswarm::experiment
