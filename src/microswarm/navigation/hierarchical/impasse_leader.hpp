// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/navigation/hierarchical/impasse.hpp"
#include "microswarm/navigation/safe_interval/safe_interval.hpp"
#include "microswarm/navigation/steering/decision.hpp"
#include "microswarm/navigation/steering/task.hpp"

namespace microswarm::navigation {

/// Leads the swarm of a HierarchicalNavigator out of an impasse: a SafeIntervalNavigator that sees
/// every frame from the first impasse on, and decides while one lasts.
class ImpasseLeader {
 public:
  ImpasseLeader(const HierarchicalParams& params, const Task& task)
      : params_(params),
        task_(task),
        impasse_(params.tuning.patience, params.target.base_distance) {}

  /// At the start of a step.
  void begin_step() { leads_ = false; }
  /// Its decision, in an impasse. The swarm is `left` [µm] before its aim; `is_alone` says whether
  /// nothing that moves is near.
  std::optional<Decision> decide(const Observation& seen, double left, bool is_alone,
                                 const Stop& stop);
  /// A command that it did not give.
  void overruled(double now, const Command& command);
  /// Whether it decided in this step.
  bool leads() const { return leads_; }
  /// Its view of the step, if it leads.
  NavigatorView view() const { return navigator_->view(); }

 private:
  HierarchicalParams params_;
  Task task_;
  Impasse impasse_;
  std::unique_ptr<SafeIntervalNavigator> navigator_;
  bool leads_ = false;
};

}  // namespace microswarm::navigation
