// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/record/rig_log.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// The run that is measured: a decision for each picture of a simulated camera of 640 × 480 pixels
/// at 100 Hz, with simulated coils, which take their share of the same cores.
struct RigRun {
  std::filesystem::path scenario, rig;
  std::vector<std::string> settings;      ///< of the scenario, KEY=VALUE
  std::vector<std::string> rig_settings;  ///< of the rig, KEY=VALUE
};

/// Benchmarks a rig in real time: times from a picture to the currents that answer it, and missed
/// deadlines, as `program rig run` drives it and in the lab with a page that watches, alone and
/// beside a busy thread for each core, then with a real-time priority as well, which the system
/// must permit. `quick` runs for a shorter time. Throws if nothing was driven.
std::vector<report::BenchRow> rig(const std::filesystem::path& scenarios,
                                  const std::filesystem::path& program, bool quick,
                                  const Stop& stop);

/// Latency of a run of `seconds` that a page of the lab arms and watches. Throws as rig.
experiment::RigLatency latency_in_lab(const RigRun& run, int seconds);

}  // namespace microswarm::bench
