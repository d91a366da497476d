// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// "CPU, compiler, microswarm version, OMPL version", for identifying measurements.
std::string machine_line();

/// Benchmarks planners, replanning and clearance queries, each with its peer in the same run and
/// world. `scenarios` is the folder of the scenario files; `quick` repeats less.
std::vector<BenchRow> planning(const std::filesystem::path& scenarios, bool quick,
                               const Stop& stop);

/// Replanning in the two dynamic worlds of [drrt], part of planning().
std::vector<BenchRow> replanning(const std::filesystem::path& scenarios, bool quick,
                                 const Stop& stop);

/// FMT* in the S-channel of Fig 3 [drrt], with the same number of samples and radius on both sides:
/// time and length of the first path. Part of planning().
std::vector<BenchRow> fmt_star(const std::filesystem::path& scenarios, bool quick,
                               const Stop& stop);

}  // namespace microswarm::bench
