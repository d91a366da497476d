// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// One decision of the radar among few and among many obstacles, beside the naive way in the same
/// places; `quick` makes fewer.
std::vector<BenchRow> radar(bool quick, const Stop& stop);

}  // namespace microswarm::bench
