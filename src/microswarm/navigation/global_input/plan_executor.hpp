// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/global_input/plan_executor_params.hpp"
#include "microswarm/navigation/steering/robot_steering_navigator.hpp"
#include "microswarm/planning/global_input/global_search.hpp"

namespace microswarm::navigation {

/// Executes a plan; see PlanExecutorParams. When robots deviate from the plan, it simulates whether
/// the rest of the plan still brings all to their goals, then whether it does from another position
/// of the plan; otherwise it replans. A plan that only leads nearer is executed too. States: play,
/// rejoin, replan, arrived, blind, and stuck if there is no plan.
class PlanExecutor : public RobotSteeringNavigator {
 public:
  using Params = PlanExecutorParams;
  static std::string_view unsupported_reason(const Task& task);

  PlanExecutor(const PlanExecutorParams& params, const Task& task, Rng rng);

  /// Executes a given plan instead of planning, as long as it leads to the goals.
  void play(planning::GlobalPlan plan) { plan_ = std::move(plan); }

 private:
  Decision decide(const Robots& robots, double now, const Stop& stop) override;
  const std::vector<Vec2>& goals() const { return robots().goals; }
  bool met(const Robots& robots) const;
  double deviation(const Robots& robots) const;
  bool leads_home(Robots robots, std::size_t from) const;
  std::optional<std::size_t> rejoin_index(const Robots& robots) const;
  NavigatorState find_path(const Robots& robots, double now, const Stop& stop);
  Command next_piece();

  PlanExecutorParams params_;
  Rng rng_;
  planning::GlobalPlan plan_;
  std::size_t input_ = 0;  ///< input of the plan being executed
  int piece_ = 0;          ///< part of that input, if it is longer than a tick's move
  Robots expected_;        ///< when the next command takes effect
  bool on_plan_ = false;
  double retry_at_ = 0;  ///< time of the next search [s]
};

}  // namespace microswarm::navigation
