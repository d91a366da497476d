// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::rig {

/// Draws map, starts and goals of a scenario over a camera's picture in colours: walls and the
/// map's edge in vermilion, starts in blue with the swarm's heading, goals in purple with the
/// tolerance around them.
void draw_scenario(formats::Image& picture, const experiment::Scenario& scenario, const Map& map,
                   const vision::CameraScale& scale);

}  // namespace microswarm::rig
