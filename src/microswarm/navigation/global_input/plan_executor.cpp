// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/global_input/plan_executor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace microswarm {

PlanExecutor::PlanExecutor(const PlanExecutorParams& params, const RobotSwarmParams& robots,
                           double goal_tolerance, double tick, Rng rng, double frame_timeout)
    : params_(params), swarm_(robots), tick_(tick), frame_timeout_(frame_timeout), rng_(rng) {
  params_.planner.goal_tolerance = goal_tolerance;
  params_.planner.contact = robots.contact;
}

void PlanExecutor::prepare(const Snapshot& world) {
  compensator_.emplace(world.map(), swarm_.max_speed * tick_, swarm_.contact, swarm_.response_lag);
}

Command PlanExecutor::step(const Observation& seen, const Stop& stop) {
  view_ = {};
  if (seen.robots.size() != swarm_.goals.size() || !sees_robots(seen, frame_timeout_))
    return issue(seen.now, {}, NavigatorState::blind);
  const Robots robots = compensator_->at_effect(seen);
  if (met(robots)) {
    on_plan_ = false;
    return issue(seen.now, {}, NavigatorState::arrived);
  }
  view_.state = NavigatorState::play;
  if (!on_plan_ || input_ == plan_.inputs.size() || off(robots) > params_.max_deviation)
    find_path(robots, seen.now, stop);
  if (input_ == plan_.inputs.size()) return issue(seen.now, {}, NavigatorState::stuck);
  return issue(seen.now, next_piece(), view_.state);
}

bool PlanExecutor::met(const Robots& robots) const {
  for (std::size_t i = 0; i < robots.size(); ++i)
    if (distance(robots.position(i), swarm_.goals[i]) > params_.planner.goal_tolerance)
      return false;
  return true;
}

double PlanExecutor::off(const Robots& robots) const {
  double worst = 0;
  for (std::size_t i = 0; i < robots.size(); ++i)
    worst = std::max(worst, distance(robots.position(i), expected_.position(i)));
  return worst;
}

bool PlanExecutor::leads_home(Robots robots, std::size_t from) const {
  for (std::size_t k = from; k < plan_.inputs.size(); ++k)
    compensator_->stepper().step(robots, plan_.inputs[k], swarm_.contact);
  return met(robots);
}

// The nearest configurations of the plan first; of two as near, the later one.
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

void PlanExecutor::find_path(const Robots& robots, double now, const Stop& stop) {
  expected_ = robots;
  if (on_plan_ && piece_ == 0 && leads_home(robots, input_) && input_ < plan_.inputs.size()) return;
  piece_ = 0;
  if (const auto k = rejoin_index(robots)) {
    input_ = *k;
    if (on_plan_) view_.state = NavigatorState::rejoin;
    on_plan_ = true;
    return;
  }
  on_plan_ = false;
  input_ = plan_.inputs.size();
  if (now < retry_at_) return;
  const std::vector<Vec2> places = robots.positions();
  plan_ =
      global_search(compensator_->map(), places, swarm_.goals, params_.planner, rng_, stop).plan;
  if (plan_.status != Status::solved) retry_at_ = now + params_.retry_time;
  input_ = 0;
  on_plan_ = true;
  view_.state = NavigatorState::replan;
  view_.planned = true;
}

Command PlanExecutor::next_piece() {
  const Vec2 input = plan_.inputs[input_];
  const int pieces =
      std::max(1, static_cast<int>(std::ceil(norm(input) / (swarm_.max_speed * tick_) - 1e-9)));
  if (++piece_ >= pieces) {
    piece_ = 0;
    ++input_;
  }
  const Command command = command_for(input / pieces, tick_);
  compensator_->stepper().step(expected_, displacement(command, tick_), swarm_.contact);
  return command;
}

Command PlanExecutor::issue(double now, Command command, NavigatorState state) {
  compensator_->issued(now, command);
  view_.state = state;
  return command;
}

}  // namespace microswarm
