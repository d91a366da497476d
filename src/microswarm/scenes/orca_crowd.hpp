// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::scenes {

/// Circle crossing as in CrowdNav (Chen, Liu, Kreiss and Alahi, "Crowd-Robot Interaction", ICRA
/// 2019): five people on a circle of 4 m walk to its other side and avoid one another (ORCA), but
/// do not see the robot, which crosses from below within 25 s. 100 µm for a metre; people and
/// robot have a radius of 0.3 m and 1 m/s. Pure function of the seed.
experiment::Scenario orca_crowd_scenario(std::uint64_t seed);

}  // namespace microswarm::scenes
