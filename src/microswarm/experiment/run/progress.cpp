// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/progress.hpp"

#include <algorithm>

namespace microswarm::experiment {

ProgressListener::ProgressListener(const Scenario& scenario,
                                   std::function<void(const RunProgress&)> report, double period)
    : time_limit_(std::max(scenario.time_limit, 1e-9)),
      report_(std::move(report)),
      period_(period) {}

void ProgressListener::on_tick(const Tick& tick) {
  const Frame& frame = tick.frame;
  if (!start_distance_) start_distance_ = std::max(frame.goal_distance, 1e-9);
  if (frame.t < next_) return;
  next_ = frame.t + period_;
  const double distance_done = 1 - frame.goal_distance / *start_distance_;
  report_({.t = frame.t,
           .distance_done = std::clamp(distance_done, 0.0, 1.0),
           .time_spent = std::clamp(frame.t / time_limit_, 0.0, 1.0)});
}

}  // namespace microswarm::experiment
