// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/robot_check.hpp"

#include <fmt/format.h>

#include "microswarm/config/write.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/world/connectivity/passage.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

void check_robots(const Scenario& scenario, const Places& where) {
  const RobotSwarmParams& robots = *scenario.robots;
  const auto fail = [&](std::string_view key, const std::string& what) {
    throw where.error(key, what);
  };
  const SwarmParams untouched;
  if (to_yaml(type_of<SwarmParams>(), &scenario.swarm) !=
      to_yaml(type_of<SwarmParams>(), &untouched))
    fail("swarm", "swarm is for a swarm of one body; it and robots are both given");
  if (scenario.start)
    fail("start", "start is for a swarm of one body; robots have robots.starts_um");
  if (!scenario.obstacles.empty())
    fail("obstacles", "robots and moving obstacles cannot be in one scenario");
  if (robots.count > 0 && !robots.starts.empty())
    fail("robots.count", "robots.count and robots.starts_um are both given");
  if (robots.count == 0 && robots.starts.empty())
    fail("robots", "no robots: give robots.count or robots.starts_um");
  if (robots.goals.empty() == !scenario.goal)
    fail("goal_um",
         scenario.goal ? "goal_um and robots.goals_um are both given" : "missing key 'goal_um'");
  if (robots.goals.empty()) return;
  if (robots.goals.size() != robots.starts.size())
    fail("robots.goals_um", fmt::format("robots.goals_um has {} places, robots.starts_um has {}",
                                        robots.goals.size(), robots.starts.size()));
  if (robots.starts.size() > most_global_robots)
    fail("robots.goals_um",
         fmt::format("{} robots with goals of their own, at most {} can be planned for",
                     robots.starts.size(), most_global_robots));
}

void check_robot_places(const Scenario& scenario, const Map& map, const Places& where) {
  const RobotSwarmParams& robots = *scenario.robots;
  std::vector<Vec2> goals = robots.goals;
  if (scenario.goal) {
    const Snapshot world(std::shared_ptr<const Map>(std::shared_ptr<void>(), &map));
    if (const auto why = world.why_blocked(*scenario.goal, 0); !why.empty())
      throw where.error("goal_um", fmt::format("goal {}", why));
    goals.assign(robots.starts.size(), *scenario.goal);
  }
  const double guard = 2 * RobotStepper(map, robots.max_speed * scenario.tick).guard();
  check_ways(map, robots.starts, goals, scenario.goal_tolerance, guard, where);
}

void check_ways(const Map& map, std::span<const Vec2> starts, std::span<const Vec2> goals,
                double tolerance, double guard, const Places& where) {
  const Snapshot world(std::shared_ptr<const Map>(std::shared_ptr<void>(), &map));
  const auto check_free = [&](std::size_t robot, const char* what, Vec2 p, double radius) {
    if (const auto why = world.why_blocked(p, radius); !why.empty())
      throw where.error(fmt::format("robots.{}s_um.{}", what, robot),
                        fmt::format("robot {}: {} {}", robot + 1, what, why));
  };
  for (std::size_t i = 0; i < starts.size(); ++i) {
    check_free(i, "start", starts[i], guard);
    check_free(i, "goal", goals[i], 0);
    if (!connected(map, starts[i], goals[i]))
      throw where.error(fmt::format("robots.starts_um.{}", i),
                        fmt::format("robot {} is cut off from its goal by walls", i + 1));
    for (std::size_t k = 0; k < i; ++k)
      if (starts[i] == starts[k] && distance(goals[i], goals[k]) > 2 * tolerance)
        throw where.error(
            fmt::format("robots.starts_um.{}", i),
            fmt::format("robots {} and {} start in one place: nothing parts them", k + 1, i + 1));
  }
}

}  // namespace microswarm
