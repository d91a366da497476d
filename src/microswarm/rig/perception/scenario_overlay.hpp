// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Draws map, starts and goals of a scenario over a camera's picture in colours: walls and the
/// map's edge in vermilion, starts in blue with the swarm's heading, goals in purple with the
/// tolerance around them.
void draw_scenario(Image& picture, const Scenario& scenario, const Map& map,
                   const CameraScale& scale);

}  // namespace microswarm
