// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/experiment/results/metrics.hpp"
#include "microswarm/experiment/run/tick.hpp"

namespace microswarm::experiment {

/// Result of a run.
struct RunResult {
  Status status = Status::time_limit;
  Metrics metrics{};
  Timing timing{};
  std::string state{};  ///< name of the navigator's last state
};

/// Interface for observers of a run: recorder, live view, progress bar. References are valid during
/// the call.
class RunListener {
 public:
  virtual ~RunListener() = default;
  /// Called after every tick; the last one has `end`.
  virtual void on_tick(const Tick& tick) = 0;
  virtual void on_end(const RunResult& result) { (void)result; }
};

}  // namespace microswarm::experiment
