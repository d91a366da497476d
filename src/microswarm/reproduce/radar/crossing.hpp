// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/experiment/run/contact_judge.hpp"

namespace microswarm::reproduce {

/// Result of one run of a campaign.
struct Crossing {
  bool ran = false;
  Status status = Status::stopped;
  bool arrived = false;  ///< reached the goal, with or without contacts
  std::size_t obstacles = 0;
  double time = 0;                  ///< [s]
  double straight = 0;              ///< time of the straight path at full speed [s]
  double delta = 0;                 ///< mean avoidance cost
  double turning = 0;               ///< [rad]
  std::optional<double> min_gap{};  ///< [µm]; empty without obstacles
  double hold_time = 0;             ///< [s]
  double step = 0;                  ///< mean wall-clock time of a decision [s]
  std::vector<experiment::ContactVerdict> contacts{};

  int avoidable() const;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.status, plain("status", "How the run ended."));
    visit(self.arrived, plain("arrived", "Whether the goal was reached."));
    visit(self.obstacles, plain("obstacles", "Number of obstacles."));
    visit(self.time, s("time", "Time of the run."));
    visit(self.straight, s("straight", "Time of the straight path at full speed."));
    visit(self.delta, plain("delta", "Mean avoidance cost."));
    visit(self.turning, rad("turning", "Total turning."));
    visit(self.min_gap, um("min_gap", "Smallest gap; null without obstacles."));
    visit(self.hold_time, s("hold_time", "Time in hold."));
    visit(self.step, s("step", "Mean wall-clock time of a decision."));
    visit(self.contacts, plain("contacts", "Verdicts on its contacts."));
  }
};

}  // namespace microswarm::reproduce
