// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_execution.hpp"

namespace microswarm {

/// Searches shorter plans while one is executed: first by repeated lookahead, then by random
/// changes. A plan is shortened only after the new one was simulated with all robots.
class RolloutSearch {
 public:
  explicit RolloutSearch(Rng rng) : rng_(rng) {}

  /// Starts for another plan, with the lookahead if there are candidates for it.
  void start(const RolloutParams& params);
  /// Drops the plan extended by the lookahead, whose robots are no longer where they should be.
  void forget_extension() { extended_.reset(); }
  /// Shortens the plan until `budget` robot-steps are spent, `max_work` is spent in all, or `stop`.
  void improve(RolloutExecution& plan, RolloutSimulator& simulator, double budget,
               const Stop& stop);
  /// Number of shorter plans found.
  int improvements() const { return improvements_; }

 private:
  bool extend(RolloutExecution& plan, RolloutSimulator& simulator);
  void perturb(RolloutExecution& plan, RolloutSimulator& simulator);
  void change(PartialPlan& partial, const RolloutExecution& plan, RolloutSimulator& simulator);
  void verify(const PartialPlan& partial, RolloutExecution& plan, RolloutSimulator& simulator);

  Rng rng_;
  std::optional<PartialPlan> extended_;  ///< plan extended by the lookahead
  std::size_t head_start_ = 0;           ///< steps after which the lookahead begins
  bool looks_ahead_ = true;
  double spent_ = 0;  ///< robot-steps in all
  int improvements_ = 0;
};

}  // namespace microswarm
