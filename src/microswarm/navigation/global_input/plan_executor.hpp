// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/navigation/global_input/plan_executor_params.hpp"
#include "microswarm/navigation/steering/robot_steering_cycle.hpp"
#include "microswarm/planning/global_input/global_search.hpp"

namespace microswarm {

/// Executes a plan; see PlanExecutorParams. When robots deviate from the plan, it simulates whether
/// the rest of the plan still brings all to their goals, then whether it does from another position
/// of the plan; otherwise it replans. A plan that only leads nearer is executed too. States: play,
/// rejoin, replan, arrived, blind, and stuck if there is no plan.
class PlanExecutor : public Navigator {
 public:
  /// `robots`: their known properties, with a goal each; `tick` [s] between two commands.
  PlanExecutor(const PlanExecutorParams& params, const RobotSwarmParams& robots,
               double goal_tolerance, double tick, Rng rng,
               double frame_timeout = default_frame_timeout);

  void prepare(const Snapshot& world, const Stop&) override { steering_.prepare(world); }
  Command step(const Observation& observation, const Stop& stop) override;
  void overruled(double now, const Command& command) override { steering_.overruled(now, command); }
  NavigatorView view() const override { return steering_.view(); }

  /// Executes a given plan instead of planning, as long as it leads to the goals.
  void play(GlobalPlan plan) { plan_ = std::move(plan); }

 private:
  const std::vector<Vec2>& goals() const { return steering_.robots().goals; }
  bool met(const Robots& robots) const;
  double deviation(const Robots& robots) const;
  bool leads_home(Robots robots, std::size_t from) const;
  std::optional<std::size_t> rejoin_index(const Robots& robots) const;
  NavigatorState find_path(const Robots& robots, double now, const Stop& stop);
  Command next_piece();

  PlanExecutorParams params_;
  Rng rng_;
  RobotSteeringCycle steering_;
  GlobalPlan plan_;
  std::size_t input_ = 0;  ///< input of the plan being executed
  int piece_ = 0;          ///< part of that input, if it is longer than a tick's move
  Robots expected_;        ///< when the next command takes effect
  bool on_plan_ = false;
  double retry_at_ = 0;  ///< time of the next search [s]
};

}  // namespace microswarm
