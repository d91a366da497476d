// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::experiment {

/// Time of a run in ticks: up to the time limit, then the time for which the swarm is held at the
/// goal. Pauses are not counted.
class RunClock {
 public:
  /// `scenario` must outlive the clock; its limits may change.
  explicit RunClock(const Scenario& scenario) : scenario_(scenario) {}

  /// Counts a tick. True if the time is over, at the goal the time to hold, else the limit.
  bool count() {
    if (at_goal_) return held_++ >= ticks(scenario_.hold_at_goal);
    return done_++ >= ticks(scenario_.time_limit);
  }
  /// Takes an arrival; false if the run ends with it, since the swarm is not held there.
  bool arrive() {
    if (scenario_.hold_at_goal <= 0) return false;
    at_goal_ = true;
    held_ = 0;
    return true;
  }
  /// Continues towards another goal.
  void leave() { at_goal_ = false; }
  /// Whether the swarm is held at the goal.
  bool at_goal() const { return at_goal_; }

 private:
  double ticks(double time) const { return std::ceil(time / scenario_.tick - 1e-9); }

  const Scenario& scenario_;
  double done_ = 0;  ///< ticks that count for the time limit
  double held_ = 0;  ///< ticks at the goal
  bool at_goal_ = false;
};

}  // namespace microswarm::experiment
