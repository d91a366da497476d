// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Sweeps: efficiency with two threads and two processes, the database of many rows. `scenarios` is
/// the folder of the shipped scenarios, `program` is microswarm.
std::vector<report::BenchRow> sweep(const std::filesystem::path& scenarios,
                                    const std::filesystem::path& program, bool quick,
                                    const Stop& stop);

}  // namespace microswarm::bench
