// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Growing the tree of [global] beside OMPL's RRT with the same local planner, on walls of polygons
/// and of pixels; its memory; asking it and loading it from its file. `quick` grows smaller trees.
std::vector<BenchRow> global(bool quick, const Stop& stop);

}  // namespace microswarm::bench
