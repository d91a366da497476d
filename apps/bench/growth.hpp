// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Benchmarks how times grow with the number of robots, obstacles, vertices of a tree and shapes of
/// a map: a row for each number, and one with the exponent fitted to them. `quick` measures less.
std::vector<report::BenchRow> growth(bool quick, const Stop& stop);

}  // namespace microswarm::bench
