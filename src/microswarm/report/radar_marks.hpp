// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// What a radar was given and went by: wait areas and waypoints, and its three circles about the
/// swarm where the gap to an obstacle was least, or else to a wall, with the outlines of obstacles
/// as they were then. Nothing for other navigators. `world` is the record's.
void draw_radar_marks(Picture& picture, const Record& record, const World& world);

}  // namespace microswarm
