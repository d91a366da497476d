// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::report {

/// Draws the moment of the minimum gap to an obstacle (or to a wall without obstacles): the swarm
/// and the outlines of obstacles then, for a radar its three circles, and the decision if the
/// record keeps diagnostics. Of a radar also the wait zones and waypoints. Does nothing for other
/// navigators without diagnostics. `world` is the record's.
void draw_min_gap(Picture& picture, const experiment::Record& record, const World& world);

}  // namespace microswarm::report
