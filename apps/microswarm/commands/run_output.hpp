// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/session/growing_record.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/report/run_report.hpp"
#include "support/cli.hpp"
#include "support/options.hpp"

namespace microswarm::cli {

/// Output options of a run.
struct RunOutput {
  std::string out;  ///< folder for run.h5 and the report; empty for none
  bool no_report = false;
  bool json = false;
  std::function<nlohmann::ordered_json()> rig_timing{};     ///< timing of a real rig
  std::function<nlohmann::ordered_json()> commissioning{};  ///< state of a rig's record
  std::function<void(std::string_view)> print = put;        ///< gets the result
};

/// Warns on stderr of unusual settings before a session runs.
void note_oddities(const experiment::Session& session);
/// Warns on stderr, after the first tick, if the method divides a map with few regions.
void note_regions(const experiment::Session& session);

/// Writes the record so far into `folder` while the session is stepped, so that `microswarm lab`
/// can follow it; null without a folder.
std::unique_ptr<experiment::GrowingRecord> grow_record(experiment::Session& session,
                                                       const std::string& folder);

/// Steps a session to its end with a progress bar.
void finish_run(experiment::Session& session, const Stop& stop);

/// Writes the record and report of a finished session and prints its result. Returns the exit code.
int tell_run(const experiment::Session& session, const RunOutput& output,
             const report::ReportOptions& report);

/// Result of a run for --json, with the record's hash.
nlohmann::ordered_json run_json(const experiment::RunResult& result, const std::string& hash);

/// Describes the end of a run: "goal reached", "held: waited for a valve,".
std::string ending(const experiment::RunResult& result);

}  // namespace microswarm::cli
