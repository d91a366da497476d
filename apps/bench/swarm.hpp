// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Stepping of robots under one input beside the naive way, on the same maps with the same moves;
/// `quick` makes fewer.
std::vector<BenchRow> swarm(bool quick, const Stop& stop);

}  // namespace microswarm::bench
