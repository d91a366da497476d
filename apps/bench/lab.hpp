// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::bench {

/// Benchmarks the lab: its server with clients of its own, and its page in a browser, if there are
/// Node.js, Chromium and the packages of web/; `scenarios` is the folder of the shipped ones.
std::vector<BenchRow> lab(const std::filesystem::path& scenarios, bool quick, const Stop& stop);

/// What web/bench.mjs measures; empty, and a note on stderr, where there is no browser.
std::vector<BenchRow> lab_in_browser(const std::filesystem::path& checkout, bool quick);

}  // namespace microswarm::bench
