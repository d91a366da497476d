// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/global_input/plan_executor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace microswarm::navigation {

std::string_view PlanExecutor::unsupported_reason(const Task& task) {
  return task.robots && !task.robots->goals.empty() ? "" : "robots with a goal each";
}

PlanExecutor::PlanExecutor(const PlanExecutorParams& params, const Task& task, Rng rng)
    : RobotSteeringNavigator(task, task.robots->goals.size()), params_(params), rng_(rng) {
  params_.planner.goal_tolerance = task.goal_tolerance;
  params_.planner.contact = task.robots->contact;
}

Decision PlanExecutor::decide(const Robots& seen, double now, const Stop& stop) {
  if (met(seen)) {
    on_plan_ = false;
    return hold(NavigatorState::arrived);
  }
  NavigatorState state = NavigatorState::play;
  if (!on_plan_ || input_ == plan_.inputs.size() || deviation(seen) > params_.max_deviation)
    state = find_path(seen, now, stop);
  if (input_ == plan_.inputs.size()) return hold(NavigatorState::stuck);
  return {next_piece(), state};
}

bool PlanExecutor::met(const Robots& robots) const {
  for (std::size_t i = 0; i < robots.size(); ++i)
    if (distance(robots.position(i), goals()[i]) > params_.planner.goal_tolerance) return false;
  return true;
}

double PlanExecutor::deviation(const Robots& robots) const {
  double worst = 0;
  for (std::size_t i = 0; i < robots.size(); ++i)
    worst = std::max(worst, distance(robots.position(i), expected_.position(i)));
  return worst;
}

bool PlanExecutor::leads_home(Robots moved, std::size_t from) const {
  for (std::size_t k = from; k < plan_.inputs.size(); ++k)
    stepper().step(moved, plan_.inputs[k], robots().contact);
  return met(moved);
}

// Tries the nearest configurations of the plan first, among equals the earlier one.
std::optional<std::size_t> PlanExecutor::rejoin_index(const Robots& robots) const {
  std::vector<std::size_t> order(plan_.inputs.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> off(order.size(), 0);
  for (const std::size_t k : order)
    for (std::size_t i = 0; i < robots.size(); ++i)
      off[k] = std::max(off[k], distance(robots.position(i), plan_.configurations[k][i]));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return off[a] < off[b]; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(params_.rejoin_candidates)));
  for (const std::size_t k : order)
    if (leads_home(robots, k)) return k;
  return std::nullopt;
}

NavigatorState PlanExecutor::find_path(const Robots& robots, double now, const Stop& stop) {
  expected_ = robots;
  if (on_plan_ && piece_ == 0 && leads_home(robots, input_) && input_ < plan_.inputs.size())
    return NavigatorState::play;
  piece_ = 0;
  if (const auto k = rejoin_index(robots)) {
    input_ = *k;
    return std::exchange(on_plan_, true) ? NavigatorState::rejoin : NavigatorState::play;
  }
  on_plan_ = false;
  input_ = plan_.inputs.size();
  if (now < retry_at_) return NavigatorState::play;
  const std::vector<Vec2> positions = robots.positions();
  plan_ = planning::global_search(map(), positions, goals(), params_.planner, rng_, stop).plan;
  if (plan_.status != Status::solved) retry_at_ = now + params_.retry_time;
  input_ = 0;
  on_plan_ = true;
  step_view().planned = true;
  return NavigatorState::replan;
}

Command PlanExecutor::next_piece() {
  const Vec2 input = plan_.inputs[input_];
  const int pieces = std::max(1, static_cast<int>(std::ceil(norm(input) / max_move() - 1e-9)));
  if (++piece_ >= pieces) {
    piece_ = 0;
    ++input_;
  }
  const Command command = command_for(input / pieces, tick());
  stepper().step(expected_, displacement(command, tick()), robots().contact);
  return command;
}

}  // namespace microswarm::navigation
