// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/experiment/monitors/contact_monitor.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::experiment {

/// Time for which a swarm has been commanded to hold, without interruption, against the hold limit
/// of the scenario.
class HoldMonitor {
 public:
  /// The scenario must outlive the monitor.
  explicit HoldMonitor(const Scenario& scenario) : scenario_(&scenario) {}

  /// Takes the command of one tick; hold_begins or hold_ends if it differs from the one before.
  std::optional<EventKind> take(const Command& command) {
    const bool held = holds();
    time_ = command.speed <= 0 ? time_ + scenario_->tick : 0;
    if (held == holds()) return std::nullopt;
    return held ? EventKind::hold_ends : EventKind::hold_begins;
  }

  bool holds() const { return time_ > 0; }
  /// Whether the hold limit of the scenario is reached.
  bool at_limit() const { return holds() && time_ >= scenario_->hold_limit - 1e-9; }

 private:
  const Scenario* scenario_;
  double time_ = 0;  ///< [s]
};

}  // namespace microswarm::experiment
