// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_execution.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_search.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_simulator.hpp"

namespace microswarm::navigation {

/// Gathers robots at the goal by a complete plan, beyond [gather]. The initial plan is the shorter
/// one of simulated HRA and DCA. Every decision then spends a budget of simulated robot-steps on
/// finding shorter plans (RolloutSearch). Without noise it therefore never needs more steps than
/// the better of the two policies, and meets the same criterion at the end. When the robots deviate
/// from the plan by more than `max_deviation`, it replans from their observed positions: by the
/// rest of the plan or by either policy, whichever is shortest. When plans fail as fast as they are
/// executed, the better policy leads to the end. Deterministic unless a deadline stops the search.
class RolloutPolicy {
 public:
  /// Map and stepper or graph of cells must outlive it. Uses `params.rollout`.
  RolloutPolicy(const AggregationMap& map, const CommonInput& input,
                const AggregationParams& params, Rng rng);

  /// Next move [µm] of all robots; nothing if they are gathered: F < σ. `stop` ends the search for
  /// better plans, not the gathering.
  std::optional<Vec2> next(const Robots& robots, const Stop& stop = {});

  /// F(n, t): mean path length to the goal [µm] at its last measurement; at the end it is the final
  /// value.
  double mean_distance() const { return mean_distance_; }
  /// Moves left in the plan; 0 if neither policy reached the end.
  std::size_t steps_left() const { return plan_.left(); }
  /// Number of times it replanned because robots deviated.
  int replans() const { return replans_; }
  /// Number of shorter plans found.
  int improvements() const { return search_.improvements(); }
  /// Simulated robot-steps so far.
  double work() const { return simulator_.work(); }
  int guard_count() const { return base_.guard_count(); }

 private:
  bool leads() const;
  bool on_plan(const Robots& robots) const;
  void measure(const Robots& robots, bool always);
  void start(const Robots& robots);
  void plan_anew(const Robots& robots);

  RolloutSimulator simulator_;
  CommonInput input_;
  const AggregationMap* map_;
  AggregationPolicy base_;  ///< leads when there is no plan
  RolloutExecution plan_;
  RolloutSearch search_;
  double mean_distance_ = 0;
  double distance_left_ = 0;    ///< [µm], at the last measurement
  int unmeasured_ = 0;          ///< moves until F is measured again
  std::size_t made_ = 0;        ///< executed moves of plans
  std::size_t base_steps_ = 0;  ///< steps of the base policy in simulation
  int replans_ = 0;
};

}  // namespace microswarm::navigation
