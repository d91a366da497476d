// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Steps of a navigator in C++, and what a call from C, Python and Octave adds; a sweep from Python
/// beside the one of `program`, microswarm. `scenarios` is the folder of the shipped scenarios.
/// What was not built has no rows.
std::vector<report::BenchRow> bindings(const std::filesystem::path& scenarios,
                                       const std::filesystem::path& program, bool quick,
                                       const Stop& stop);

}  // namespace microswarm::bench
