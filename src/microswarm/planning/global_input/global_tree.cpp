// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::planning {
namespace {

/// A sine or cosine, exactly 0 on the axes.
double without_dust(double x) { return std::abs(x) < 1e-12 ? 0 : x; }

void check_goals(std::size_t goals, std::size_t robots) {
  if (goals != robots)
    throw InputError("goals: " + std::to_string(goals) + " given for " + std::to_string(robots) +
                     " robots");
}

}  // namespace

std::vector<PointF> input_moves(int directions, double robostep) {
  std::vector<PointF> moves;
  for (int a = 0; a < directions; ++a) {
    const Vec2 u = unit_vector(2 * pi * a / directions);
    moves.push_back({static_cast<float>(robostep * without_dust(u.x)),
                     static_cast<float>(robostep * without_dust(u.y))});
  }
  return moves;
}

// Slightly more than a step, since the moves are rounded.
RobotStepper input_stepper(const Map& map, double robostep) { return {map, 1.001 * robostep}; }

std::vector<Vec2> GlobalTree::positions(std::uint32_t node) const {
  std::vector<Vec2> all;
  for (std::size_t i = 0; i < robots; ++i) all.push_back(position(node, i));
  return all;
}

void GlobalTree::add(std::span<const float> configuration, std::uint32_t parent,
                     std::uint8_t input) {
  configurations.insert(configurations.end(), configuration.begin(), configuration.end());
  parents.push_back(parent);
  inputs.push_back(input);
}

void GlobalTree::reserve(std::size_t nodes) {
  configurations.reserve(2 * robots * nodes);
  parents.reserve(nodes);
  inputs.reserve(nodes);
}

std::size_t GlobalTree::bytes() const {
  return configurations.capacity() * sizeof(float) + parents.capacity() * sizeof(std::uint32_t) +
         inputs.capacity();
}

GoalAnswer ask(const GlobalTree& tree, std::span<const Vec2> goals, double tolerance) {
  check_goals(goals.size(), tree.robots);
  GoalAnswer answer;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t node = 0; node < tree.size(); ++node) {
    double worst = 0;
    for (std::size_t i = 0; i < tree.robots && worst < least; ++i)
      worst = std::max(worst, squared_norm(tree.position(node, i) - goals[i]));
    if (worst >= least) continue;
    least = worst;
    answer.node = node;
  }
  answer.worst = std::sqrt(least);
  if (answer.worst <= tolerance) answer.status = Status::solved;
  return answer;
}

GlobalPlan plan_to(const GlobalTree& tree, const GoalAnswer& answer) {
  GlobalPlan plan;
  plan.status = answer.status;
  plan.worst = answer.worst;
  std::uint32_t node = answer.node;
  for (; node != 0; node = tree.parents[node]) {
    const PointF move = tree.moves[tree.inputs[node]];
    plan.inputs.push_back({static_cast<double>(move.x), static_cast<double>(move.y)});
    plan.configurations.push_back(tree.positions(node));
  }
  plan.configurations.push_back(tree.positions(0));
  std::ranges::reverse(plan.inputs);
  std::ranges::reverse(plan.configurations);
  return plan;
}

void check_robots(std::span<const Vec2> starts, std::span<const Vec2> goals) {
  if (starts.empty() || starts.size() > max_global_robots)
    throw InputError("starts: " + std::to_string(starts.size()) + " robots, allowed are 1 to " +
                     std::to_string(max_global_robots));
  if (!goals.empty()) check_goals(goals.size(), starts.size());
}

}  // namespace microswarm::planning
