// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_execution.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_layers.hpp"

namespace microswarm::navigation {

/// Searches shorter plans while one is executed: by layers
/// and by random changes in turn. A plan is shortened only after the new one was simulated with all
/// robots.
class RolloutSearch {
 public:
  explicit RolloutSearch(Rng rng) : rng_(rng) {}

  /// Starts for another plan, with layers if there are candidates for them.
  void start(const RolloutParams& params);
  /// Drops the search by layers, whose robots are no longer where they should be.
  void forget_layers() { layers_.reset(); }
  /// Shortens the plan until `budget` robot-steps are spent, `max_work` is spent in all, or `stop`.
  void improve(RolloutExecution& plan, RolloutSimulator& simulator, double budget,
               const Stop& stop);
  /// Number of shorter plans found.
  int improvements() const { return improvements_; }

 private:
  bool begin_layers(const RolloutExecution& plan, RolloutSimulator& simulator, double budget);
  bool expand(RolloutExecution& plan, RolloutSimulator& simulator, double budget);
  void take(const LayerPath& path, RolloutExecution& plan, RolloutSimulator& simulator);
  void perturb(RolloutExecution& plan, RolloutSimulator& simulator, double budget);

  Rng rng_;
  std::optional<RolloutLayers> layers_;
  double pass_until_ = 0;     ///< robot-steps in all at which the first pass should be done
  double layers_until_ = 0;   ///< robot-steps in all at which the layers are given up
  double changes_until_ = 0;  ///< and the random changes
  bool by_layers_ = true;
  double spent_ = 0;  ///< robot-steps in all
  int improvements_ = 0;
  int improved_ = 0;  ///< improvements when the layers began
};

}  // namespace microswarm::navigation
