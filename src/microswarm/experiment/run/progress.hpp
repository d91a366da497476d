// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "microswarm/experiment/run/run.hpp"

namespace microswarm {

/// How far a run is: the share of the way that is behind it (by distance from the goal), and of its
/// simulated time limit.
struct RunProgress {
  double t = 0;           ///< [s]
  double way_done = 0;    ///< in [0, 1]
  double time_spent = 0;  ///< in [0, 1]
};

/// Tells a callback at most every `period` seconds of simulated time.
class ProgressListener : public RunListener {
 public:
  ProgressListener(const Scenario& scenario, std::function<void(const RunProgress&)> report,
                   double period = 1);
  void on_tick(const Tick& tick) override;

 private:
  std::optional<double> start_distance_;  // from the first frame on
  double time_limit_;
  std::function<void(const RunProgress&)> report_;
  double period_;
  double next_ = 0;
};

}  // namespace microswarm
