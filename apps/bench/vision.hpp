// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Benchmarks detecting and tracking 600 robots in a synthetic video of 640 × 424 pixels, on one
/// core, in time per frame against plain OpenCV detection in the same frames; and the same for one
/// swarm in frames of 640 × 480 pixels. `quick` takes fewer frames.
std::vector<report::BenchRow> vision(bool quick, const Stop& stop);

}  // namespace microswarm::bench
