// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/experiment/run/run.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/report/run_report.hpp"
#include "options.hpp"

namespace microswarm::cli {

/// What is kept and said of a run.
struct RunOutput {
  std::string out;  ///< folder for run.h5 and the report; empty: nothing is kept
  bool no_report = false;
  bool json = false;
  std::string rig{};  ///< name of the rig it runs on; empty for a simulation
  std::function<nlohmann::ordered_json()> rig_timing{};  ///< of that rig, when the run is over
  std::optional<double> seconds{};  ///< after which it is ended, though the goal is not reached
};

/// Runs a scene, with these listening.
using Runner = std::function<RunResult(std::span<RunListener* const>, const Stop&)>;

/// Runs a scene once, with a progress bar, keeps its record and report, says how it went. The exit
/// code. Without a runner it is simulated.
int run_once(const Scene& scene, const World& world, const RunOutput& output,
             const ReportOptions& report, const Stop& stop, const Runner& runner = {});

nlohmann::ordered_json to_json(const RunResult& result, const std::string& hash);

/// How a run ended, for people: "goal reached", "held: waited for a valve,".
std::string ending(const RunResult& result);

}  // namespace microswarm::cli
