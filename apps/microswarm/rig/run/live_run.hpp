// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "commands/run_output.hpp"
#include "microswarm/rig/session/live_session.hpp"
#include "rig/real_coils.hpp"

namespace microswarm::cli {

/// Options of a run on a rig in real time.
struct LiveRunOptions {
  rig::LiveOptions live{};                            ///< `folder` gets record and report, too
  bool json = false;                                  ///< the result is JSON
  std::function<void(std::string_view)> print = put;  ///< gets the result
  /// Called when the coils were commanded to zero, with the status or the fault.
  std::function<void(const std::string&)> ended = [](const std::string&) {};
  /// Called after it with a fault, before the record is written.
  std::function<void(const std::string&)> failed = [](const std::string&) {};
};

/// End of a run on a rig.
struct LiveRunEnd {
  int code = ok;  ///< exit code of `rig run`
  Status status = Status::running;
  std::string ending{};  ///< in words
  double t = 0;          ///< of the last tick, on the record's clock [s]
  std::string fault{};   ///< empty without one
  rig::FaultKind kind = rig::FaultKind::none;
  std::optional<double> max_temperature{};  ///< of the coil nearest to its limit [°C]
  std::string lost{};                       ///< data that could not be written
};

/// Runs an experiment on its rig to its end, operated by keys, with a status line; notes go to
/// stderr. Throws as LiveSession, and InputError if the record cannot be written.
LiveRunEnd run_live(const rig::RigExperiment& on, const LiveRunOptions& options,
                    const Context& context);

}  // namespace microswarm::cli
