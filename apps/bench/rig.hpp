// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Benchmarks a rig in real time at 100 Hz, as `program rig run` drives it, with a simulated camera
/// of 640 × 480 pixels and simulated coils, which take their share of the same cores: times from a
/// picture to the currents that answer it, and missed deadlines. `quick` runs for a shorter time.
/// Throws if the program cannot drive.
std::vector<report::BenchRow> rig(const std::filesystem::path& scenarios,
                                  const std::filesystem::path& program, bool quick,
                                  const Stop& stop);

}  // namespace microswarm::bench
