// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Benchmarks tree growth of [global] against OMPL's RRT with the same local planner, on polygon
/// and pixel walls; its memory; querying the tree and loading it from its file. `quick` grows
/// smaller trees.
std::vector<report::BenchRow> global(bool quick, const Stop& stop);

}  // namespace microswarm::bench
