// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/stop.hpp"
#include "microswarm/navigation/gathering/rollout_simulator.hpp"

namespace microswarm {

/// Gathers robots at the goal by a plan to the end, beyond [gather]. The plan is at first the
/// shorter one of what HRA and DCA would do, found by simulating them; every decision then spends a
/// budget of simulated robot-steps on shorter ones, and the plan is replaced only by a plan that
/// all robots were simulated with. So without noise it never takes more steps than the better of
/// the two, and ends where that ends. When the robots max_deviation from it, it plans anew from
/// where they are seen: by the rest of the plan or by either policy, whichever is the shortest.
/// When plans slip as fast as they are followed, the better policy leads to the end. Deterministic
/// unless a deadline stops its thinking.
class RolloutPolicy {
 public:
  /// Map and stepper, of the rule "stop", must outlive it. Uses `params.rollout`.
  RolloutPolicy(const AggregationMap& map, const RobotStepper& stepper,
                const AggregationParams& params, Rng rng);

  /// The next move [µm] of all robots; nothing when they are gathered: F < σ. `stop` ends the
  /// thinking, not the gathering.
  std::optional<Vec2> next(const Robots& robots, const Stop& stop = {});

  /// F(n, t): mean way to the goal [µm] when it was measured last; at the end it is that of then.
  double mean_distance() const { return mean_distance_; }
  /// Moves left in the plan; 0 when neither policy has found an end.
  std::size_t steps_left() const { return plan_.moves.size() - done_; }
  /// How often it planned anew since robots strayed.
  int replans() const { return replans_; }
  /// How often a shorter plan was found.
  int improvements() const { return improvements_; }
  /// Simulated robot-steps so far.
  double work() const { return simulator_.work(); }
  int guard_count() const { return base_.guard_count(); }

 private:
  bool leads() const;
  bool on_plan(const Robots& robots) const;
  void look(const Robots& robots, bool always);
  void start(const Robots& robots);
  void plan_anew(const Robots& robots);
  std::optional<PartialPlan> simulated(const Robots& robots, Aggregation method, std::size_t most);
  void improve(double budget, const Stop& stop);
  bool extend();
  void perturb();
  void change(PartialPlan& partial);
  void verify(const PartialPlan& partial);
  void adopt(PartialPlan&& partial);
  PartialPlan partial_at(std::size_t step, std::size_t max_places);
  std::size_t steps() const { return plan_.moves.size(); }

  RolloutSimulator simulator_;
  RolloutParams params_;
  const RobotStepper* stepper_;
  Rng rng_;
  const AggregationMap* map_;
  AggregationPolicy base_;  ///< leads when no plan does
  RolloutPlan plan_;
  std::size_t done_ = 0;                 ///< moves of the plan that were made
  MergedRobots expected_;                ///< where robots are when they follow it
  std::optional<PartialPlan> extended_;  ///< plan that is grown by looking ahead
  std::size_t head_start_ = 0;           ///< steps after which that begins
  bool looks_ahead_ = true;
  double thought_ = 0;  ///< work on better plans
  double mean_distance_ = 0;
  int unmeasured_ = 0;          ///< moves until F is measured again
  std::size_t made_ = 0;        ///< moves of plans
  std::size_t base_steps_ = 0;  ///< what the base needed in the simulation
  int replans_ = 0;
  int improvements_ = 0;
};

}  // namespace microswarm
