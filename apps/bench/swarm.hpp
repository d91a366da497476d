// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Benchmarks stepping of robots under one input against a naive implementation, with the same maps
/// and moves; `quick` makes fewer.
std::vector<report::BenchRow> swarm(bool quick, const Stop& stop);

}  // namespace microswarm::bench
