// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Time a frame to find and follow 600 robots in a drawn video of 640 × 424 pixels, on one core,
/// beside OpenCV's plain way to find them in the same frames; the same for one swarm in frames of
/// 640 × 480 pixels. `quick` takes fewer frames.
std::vector<BenchRow> vision(bool quick, const Stop& stop);

}  // namespace microswarm::bench
