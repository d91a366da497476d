// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/eye.hpp"

#include "microswarm/rig/robot_eye.hpp"
#include "microswarm/rig/swarm_eye.hpp"

namespace microswarm {

std::unique_ptr<Eye> make_eye(const EyeParams& params, const Scenario& scenario, const Map& map,
                              const std::vector<Vec2>& starts, const CameraView& view) {
  if (scenario.robots)
    return std::make_unique<RobotEye>(params, *scenario.robots, map, starts, view);
  return std::make_unique<SwarmEye>(params, map, *scenario.start, view);
}

}  // namespace microswarm
