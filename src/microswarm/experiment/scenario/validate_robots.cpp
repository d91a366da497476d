// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/validate_robots.hpp"

#include <fmt/format.h>

#include "microswarm/config/write.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "microswarm/world/connectivity/passage.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::experiment {

Issues validate_robots(const Scenario& scenario) {
  Issues issues;
  const RobotSwarmParams& robots = *scenario.robots;
  const SwarmParams untouched;
  if (to_yaml(type_of<SwarmParams>(), &scenario.swarm) !=
      to_yaml(type_of<SwarmParams>(), &untouched))
    issues.add("swarm", "swarm is for a swarm of one body; it and robots are both given");
  if (scenario.start)
    issues.add("start", "start is for a swarm of one body; robots have robots.starts_um");
  if (!scenario.obstacles.empty())
    issues.add("obstacles", "robots and moving obstacles cannot be in one scenario");
  if (robots.count > 0 && !robots.starts.empty())
    issues.add("robots.count", "robots.count and robots.starts_um are both given");
  if (robots.count == 0 && robots.starts.empty())
    issues.add("robots", "no robots: give robots.count or robots.starts_um");
  if (robots.goals.empty() == !scenario.goal)
    issues.add("goal_um", scenario.goal ? "goal_um and robots.goals_um are both given"
                                        : "missing key 'goal_um'");
  if (robots.goals.empty()) return issues;
  if (robots.goals.size() != robots.starts.size())
    issues.add("robots.goals_um",
               fmt::format("robots.goals_um has {} places, robots.starts_um has {}",
                           robots.goals.size(), robots.starts.size()));
  if (robots.starts.size() > planning::max_global_robots)
    issues.add("robots.goals_um",
               fmt::format("{} robots with goals of their own, at most {} can be planned for",
                           robots.starts.size(), planning::max_global_robots));
  return issues;
}

Issues validate_robot_positions(const Scenario& scenario, const Map& map) {
  Issues issues;
  const RobotSwarmParams& robots = *scenario.robots;
  std::vector<Vec2> goals = robots.goals;
  if (scenario.goal) {
    const Snapshot world = Snapshot::of(map);
    if (const auto why = world.blocked_reason(*scenario.goal, 0); !why.empty())
      issues.add("goal_um", fmt::format("goal {}", why));
    if (!issues.empty()) return issues;
    goals.assign(robots.starts.size(), *scenario.goal);
  }
  const double guard = 2 * RobotStepper(map, robots.max_speed * scenario.tick).guard();
  return validate_robot_paths(map, robots.starts, goals, scenario.goal_tolerance, guard);
}

Issues validate_robot_paths(const Map& map, std::span<const Vec2> starts,
                            std::span<const Vec2> goals, double tolerance, double guard) {
  Issues issues;
  const Snapshot world = Snapshot::of(map);
  const auto is_free = [&](std::size_t robot, const char* what, Vec2 p, double radius) {
    const std::string why = world.blocked_reason(p, radius);
    if (!why.empty())
      issues.add(fmt::format("robots.{}s_um.{}", what, robot),
                 fmt::format("robot {}: {} {}", robot + 1, what, why));
    return why.empty();
  };
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const bool starts_free = is_free(i, "start", starts[i], guard);
    const bool ends_free = is_free(i, "goal", goals[i], 0);
    const std::string key = fmt::format("robots.starts_um.{}", i);
    if (starts_free && ends_free && !connected(map, starts[i], goals[i]))
      issues.add(key, fmt::format("robot {} is cut off from its goal by walls", i + 1));
    for (std::size_t k = 0; k < i; ++k)
      if (starts[i] == starts[k] && distance(goals[i], goals[k]) > 2 * tolerance)
        issues.add(key, fmt::format("robots {} and {} start in one place: nothing parts them",
                                    k + 1, i + 1));
  }
  return issues;
}

}  // namespace microswarm::experiment
