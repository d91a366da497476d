// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Benchmarks the lab: its server with simulated clients, and its page in a browser, if Node.js,
/// Chromium and the packages of web/ are available; `scenarios` is the folder of the shipped ones.
std::vector<report::BenchRow> lab(const std::filesystem::path& scenarios, bool quick,
                                  const Stop& stop);

/// Rows measured by web/bench.mjs; empty, with a note on stderr, without a browser.
std::vector<report::BenchRow> lab_in_browser(const std::filesystem::path& checkout, bool quick);

}  // namespace microswarm::bench
