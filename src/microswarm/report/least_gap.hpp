// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::report {

/// Draws the wait zones and waypoints of a radar, its three circles around the swarm at the minimum
/// gap to an obstacle (or to a wall without obstacles), and the outlines of obstacles at that time.
/// Does nothing for other navigators. `world` is the record's.
void draw_radar_marks(Picture& picture, const experiment::Record& record, const World& world);

}  // namespace microswarm::report
