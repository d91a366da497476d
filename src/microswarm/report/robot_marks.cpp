// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/robot_marks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace microswarm::report {
namespace {

constexpr std::size_t max_coloured = 8;

/// Robots drawn as one spot because they would overlap.
struct Pile {
  Vec2 position;
  int count = 0;
};

std::vector<Pile> find_piles(std::span<const Vec2> positions, double spot) {
  std::map<std::pair<int, int>, Pile> by_cell;
  for (const Vec2 p : positions) {
    Pile& pile = by_cell[{static_cast<int>(p.x / spot), static_cast<int>(p.y / spot)}];
    pile.position += p;
    ++pile.count;
  }
  std::vector<Pile> piles;
  piles.reserve(by_cell.size());
  for (const auto& [cell, pile] : by_cell)
    piles.push_back({pile.position / static_cast<double>(pile.count), pile.count});
  return piles;
}

}  // namespace

bool are_few(const RobotSwarmParams& robots) { return robots.starts.size() - 1 < max_coloured; }

Colour robot_colour(const RobotSwarmParams& robots, std::size_t robot) {
  return are_few(robots) ? colours::robots[robot % colours::robots.size()] : colours::swarm;
}

void draw_robot_marks(Picture& picture, const experiment::Scenario& scenario, const Box& bounds,
                      std::span<const Vec2> positions) {
  if (are_few(*scenario.robots)) {
    for (std::size_t i = 0; i < positions.size(); ++i)
      picture.disc({positions[i], 0}, robot_colour(*scenario.robots, i));
    return;
  }
  const double pixel = std::max(bounds.width(), bounds.height()) / 1200;  // [µm] of the picture
  for (const Pile& pile : find_piles(positions, 6 * pixel))
    picture.disc({pile.position, pixel * (3 + 0.8 * std::sqrt(pile.count))}, colours::swarm);
  picture.legend("robots; a larger spot is a pile of them", colours::swarm, true);
}

void draw_robot_goals(Picture& picture, const experiment::Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.robots->goals.size(); ++i)
    picture.circle({scenario.robots->goals[i], scenario.goal_tolerance},
                   robot_colour(*scenario.robots, i), 2);
  if (scenario.goal) picture.mark(*scenario.goal, "goal", colours::goal);
}

}  // namespace microswarm::report
