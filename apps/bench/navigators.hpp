// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Runs every navigator through one scene of each kind of the arena: times of a decision, and the
/// time to the goal over the earliest arrival of one that knows all motions; `quick` takes fewer
/// kinds.
std::vector<report::BenchRow> navigators(bool quick, const Stop& stop);

}  // namespace microswarm::bench
