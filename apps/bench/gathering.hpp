// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Steps that gather robots with each method: on the mazes of the set gym-gathering, if
/// MICROSWARM_DATA names their folder, by its rules and by ours, and on three maps with 1,024
/// robots. Each row is the mean of five seeds (`quick`: two) beside dynamic shortest path.
std::vector<report::BenchRow> gather(bool quick, const Stop& stop);

}  // namespace microswarm::bench
