// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "microswarm/experiment/run/run_listener.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::experiment {

/// Progress of a run: the completed fraction of the initial goal distance and the elapsed fraction
/// of the simulated time limit.
struct RunProgress {
  double t = 0;              ///< [s]
  double distance_done = 0;  ///< in [0, 1]
  double time_spent = 0;     ///< in [0, 1]
};

/// Calls a function at most every `period` seconds of simulated time.
class ProgressListener : public RunListener {
 public:
  ProgressListener(const Scenario& scenario, std::function<void(const RunProgress&)> report,
                   double period = 1);
  void on_tick(const Tick& tick) override;

 private:
  std::optional<double> start_distance_;  // set by the first frame
  double time_limit_;
  std::function<void(const RunProgress&)> report_;
  double period_;
  double next_ = 0;
};

}  // namespace microswarm::experiment
