// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/global_input/plan_executor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace microswarm {

PlanExecutor::PlanExecutor(const PlanExecutorParams& params, const RobotSwarmParams& robots,
                           double goal_tolerance, double tick, Rng rng, double frame_timeout)
    : params_(params), rng_(rng), steering_(robots, tick, frame_timeout) {
  params_.planner.goal_tolerance = goal_tolerance;
  params_.planner.contact = robots.contact;
}

Command PlanExecutor::step(const Observation& seen, const Stop& stop) {
  const std::optional<Robots> robots = steering_.observe(seen, goals().size());
  if (!robots) return steering_.hold();
  if (met(*robots)) {
    on_plan_ = false;
    return steering_.hold(NavigatorState::arrived);
  }
  NavigatorState state = NavigatorState::play;
  if (!on_plan_ || input_ == plan_.inputs.size() || deviation(*robots) > params_.max_deviation)
    state = find_path(*robots, seen.now, stop);
  if (input_ == plan_.inputs.size()) return steering_.hold(NavigatorState::stuck);
  return steering_.command(next_piece(), state);
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

bool PlanExecutor::leads_home(Robots robots, std::size_t from) const {
  for (std::size_t k = from; k < plan_.inputs.size(); ++k)
    steering_.stepper().step(robots, plan_.inputs[k], steering_.robots().contact);
  return met(robots);
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
  plan_ = global_search(steering_.map(), positions, goals(), params_.planner, rng_, stop).plan;
  if (plan_.status != Status::solved) retry_at_ = now + params_.retry_time;
  input_ = 0;
  on_plan_ = true;
  steering_.view().planned = true;
  return NavigatorState::replan;
}

Command PlanExecutor::next_piece() {
  const Vec2 input = plan_.inputs[input_];
  const int pieces =
      std::max(1, static_cast<int>(std::ceil(norm(input) / (steering_.max_move()) - 1e-9)));
  if (++piece_ >= pieces) {
    piece_ = 0;
    ++input_;
  }
  const Command command = command_for(input / pieces, steering_.tick());
  steering_.stepper().step(expected_, displacement(command, steering_.tick()),
                           steering_.robots().contact);
  return command;
}

}  // namespace microswarm
