// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Benchmarks one decision of the radar among few and many obstacles against a naive implementation
/// at the same positions; `quick` makes fewer.
std::vector<BenchRow> radar(bool quick, const Stop& stop);

}  // namespace microswarm::bench
