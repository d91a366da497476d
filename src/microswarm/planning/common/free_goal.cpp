// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/core/maths/heap_entry.hpp"

#include <numbers>
#include <queue>
#include <vector>

namespace microswarm::planning {
namespace {

constexpr int finest_level = 6;
constexpr std::size_t max_squares = 5'000;

/// Square of a quadtree around the goal.
struct Square {
  Vec2 centre;
  double half = 0;
  int level = 0;
};

/// Moves a blocked point along the clearance gradient until it is free; nothing if that fails.
template <class World>
std::optional<Vec2> pushed(const World& world, Vec2 p, double clearance) {
  constexpr double step = 1e-3;  // of the gradient [µm]
  constexpr int max_pushes = 4;
  for (int push = 0; push < max_pushes; ++push) {
    const double lacking = clearance - world.clearance(p);
    if (lacking <= 0) return p;
    const Vec2 slope{world.clearance(p + Vec2{step, 0}) - world.clearance(p - Vec2{step, 0}),
                     world.clearance(p + Vec2{0, step}) - world.clearance(p - Vec2{0, step})};
    if (norm(slope) < step) return std::nullopt;
    p += (lacking + 1e-9) / norm(slope) * slope;
  }
  return world.is_free(p, clearance) ? std::optional(p) : std::nullopt;
}

double min_distance(Vec2 goal, Vec2 centre, double half) {
  const double dx = std::max(0.0, std::abs(goal.x - centre.x) - half);
  const double dy = std::max(0.0, std::abs(goal.y - centre.y) - half);
  return norm({dx, dy});
}

/// Nearest free point among the centres of the squares or, with `pushing`, also beside them.
std::optional<Vec2> search(const Snapshot& world, Vec2 goal, double tolerance, double clearance,
                           bool pushing) {
  const GoalArea area(world.map(), goal, tolerance);
  std::optional<Vec2> best;
  double best_distance = tolerance;
  std::vector<Square> squares{{goal, tolerance, 0}};
  // By the minimum distance from the goal, among equals the coarser and earlier one.
  std::priority_queue<HeapEntry<double>> open;
  open.push({0, 0});
  while (!open.empty() && squares.size() < max_squares) {
    const auto [nearest, number] = open.top();
    const Square square = squares[number];
    open.pop();
    if (nearest > best_distance || (best && nearest == best_distance)) break;
    // Clearance changes by at most 1 µm per µm, so no point of the square can have enough.
    const double reach = square.half * std::numbers::sqrt2;
    if (world.clearance(square.centre) + reach < clearance) continue;
    const Vec2 position =
        pushing ? pushed(world, square.centre, clearance).value_or(square.centre) : square.centre;
    const double to_goal = distance(position, goal);
    if (to_goal <= best_distance && world.is_free(position, clearance) && area.contains(position)) {
      best = position;
      best_distance = to_goal;
    }
    if (square.level == finest_level) continue;
    const double half = square.half / 2;
    for (const Vec2 corner : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{1, 1}}) {
      const Vec2 centre = square.centre + half * corner;
      open.push({min_distance(goal, centre, half), static_cast<std::uint32_t>(squares.size())});
      squares.push_back({centre, half, square.level + 1});
    }
  }
  return best;
}

}  // namespace

std::optional<Vec2> free_goal(const Snapshot& world, Vec2 goal, double tolerance,
                              double clearance) {
  if (!is_finite(goal)) return std::nullopt;
  if (world.is_free(goal, clearance)) return goal;
  if (const auto found = search(world, goal, tolerance, clearance, false)) return found;
  return search(world, goal, tolerance, clearance, true);
}

std::optional<Vec2> pushed_free(const Map& map, Vec2 position, double clearance) {
  return pushed(map, position, clearance);
}

Target find_target(const Snapshot& world, Vec2 start, Vec2 goal, double tolerance,
                   double clearance) {
  if (!is_finite(start) || !world.is_free(start, clearance))
    return {.fault = Status::start_blocked, .position = {}};
  const auto position = free_goal(world, goal, tolerance, clearance);
  if (!position) return {.fault = Status::goal_blocked, .position = {}};
  return {.fault = std::nullopt, .position = *position};
}

}  // namespace microswarm::planning
