// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/navigation/global_input/plan_executor_params.hpp"
#include "microswarm/navigation/global_input/robot_delay_compensator.hpp"
#include "microswarm/planning/global_input/global_search.hpp"

namespace microswarm {

/// See PlanExecutorParams. When robots max_deviation it tries, by playing the rest of the plan
/// through on its own model, whether that still brings all to their goals; then whether it does
/// from another place of the plan; else it plans anew from where they are. A plan that leads only
/// nearer is played too. States: play, rejoin, replan, arrived, blind, and stuck when there is no
/// plan.
class PlanExecutor : public Navigator {
 public:
  /// `robots`: what is known of them, with a goal each; `tick` [s] between two commands.
  PlanExecutor(const PlanExecutorParams& params, const RobotSwarmParams& robots,
               double goal_tolerance, double tick, Rng rng,
               double frame_timeout = default_frame_timeout);

  void prepare(const Snapshot& world) override;
  Command step(const Observation& observation, const Stop& stop) override;
  NavigatorView view() const override { return view_; }

  /// Plays this plan in place of one of its own, as long as it leads to the goals.
  void play(GlobalPlan plan) { plan_ = std::move(plan); }

 private:
  bool met(const Robots& robots) const;
  double off(const Robots& robots) const;
  bool leads_home(Robots robots, std::size_t from) const;
  std::optional<std::size_t> rejoin_index(const Robots& robots) const;
  void find_path(const Robots& robots, double now, const Stop& stop);
  Command next_piece();
  Command issue(double now, Command command, NavigatorState state);

  PlanExecutorParams params_;
  RobotSwarmParams swarm_;
  double tick_;
  double frame_timeout_;  ///< [s]
  Rng rng_;
  std::optional<RobotDelayCompensator> compensator_;
  GlobalPlan plan_;
  std::size_t input_ = 0;  ///< of the plan, being played
  int piece_ = 0;          ///< of that input, which is more than a tick's way
  Robots expected_;        ///< when the next command takes effect
  bool on_plan_ = false;
  double retry_at_ = 0;  ///< [s] not to be searched for before
  NavigatorView view_;
};

}  // namespace microswarm
