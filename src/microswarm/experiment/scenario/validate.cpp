// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/validate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/experiment/scenario/passages.hpp"
#include "microswarm/experiment/scenario/validate_radar.hpp"
#include "microswarm/experiment/scenario/validate_robots.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/world/connectivity/passage.hpp"

namespace microswarm::experiment {
namespace {

// A navigator for which every observation is too old would never move.
Issues validate_sensing(const Scenario& scenario) {
  Issues issues;
  const double timeout = scenario.sensing.frame_timeout;
  const double delay = scenario.sensing.observation_delay;
  if (delay > timeout)
    issues.add({"sensing.observation_delay_s", "sensing.frame_timeout_s"},
               fmt::format("sensing.observation_delay_s is {:.4g}, more than "
                           "sensing.frame_timeout_s, {:.4g}: every frame would be too old",
                           delay, timeout));
  return issues;
}

std::string goal_text(const std::string& why, const Scenario& scenario) {
  return fmt::format("goal {}, and {:.3g} of goal_tolerance_um is only {:.4g} µm", why,
                     navigation::aim_share, navigation::aim_share * scenario.goal_tolerance);
}

// The navigator may require more clearance than the swarm needs.
Issues validate_margin(const Scenario& scenario, const World& world) {
  Issues issues;
  const double margin = navigation::required_clearance(scenario.navigator);
  const Snapshot walls(world.map);
  const auto target =
      navigation::reachable_goal(walls, *scenario.goal, scenario.goal_tolerance, margin);
  if (!target) {
    issues.add({"goal_um", "navigator.clearance_um"},
               goal_text(walls.blocked_reason(*scenario.goal, margin) + " (navigator.clearance_um)",
                         scenario));
    return issues;
  }
  // A start closer to a wall is allowed: the navigator leads away from it.
  const double needed = std::min(margin, world.map->clearance(scenario.start->position));
  if (leads_to(*world.map, scenario.start->position, *target, needed)) return issues;
  issues.add(
      "navigator.clearance_um",
      fmt::format("navigator.clearance_um is {:.4g}, wider than the passages to the goal "
                  "allow{}",
                  margin, tightest_text(*world.map, scenario.start->position, *target, margin)));
  return issues;
}

Issues validate_body(const Scenario& scenario, const World& world) {
  Issues issues;
  const double radius = swarm_limits(scenario.swarm).radius;
  if (!scenario.start)
    issues.add("start", "missing key 'start'");
  else if (const auto why = world.at(0).blocked_reason(scenario.start->position, radius);
           !why.empty())
    issues.add("start", fmt::format("start {}", why));
  if (!scenario.goal) {
    issues.add("goal_um", "missing key 'goal_um'");
    return issues;
  }
  const Snapshot walls(world.map);
  if (const std::string why = walls.blocked_reason(*scenario.goal, 0); !why.empty())
    issues.add("goal_um", fmt::format("goal {}", why));
  if (!issues.empty()) return issues;
  // The swarm's centre may stop anywhere within the tolerance.
  const auto target =
      navigation::reachable_goal(walls, *scenario.goal, scenario.goal_tolerance, radius);
  if (!target)
    issues.add("goal_um", goal_text(walls.blocked_reason(*scenario.goal, radius), scenario));
  if (!issues.empty()) return issues;
  issues = validate_path(*world.map, scenario.start->position, *target, radius);
  if (issues.empty()) issues = validate_margin(scenario, world);
  if (issues.empty()) issues = validate_radar_passages(scenario, world);
  return issues;
}

}  // namespace

Issues validate_path(const Map& map, Vec2 start, Vec2 goal, double radius) {
  Issues issues;
  if (leads_to(map, start, goal, radius)) return issues;
  const WidestPath path = widest_path(map, start, goal, radius);
  if (!path.found && !connected(map, start, goal)) {
    issues.add("goal_um", "goal is cut off from the start by walls");
    return issues;
  }
  issues.add({"swarm.radius_um", "swarm", "goal_um"},
             fmt::format("swarm is {:.4g} µm wide, wider than every passage to the goal: the "
                         "widest is about {:.3g} µm, at ({:.4g}, {:.4g}) µm",
                         2 * radius, 2 * path.clearance, path.tightest.x, path.tightest.y));
  return issues;
}

Notes goal_notes(const Scenario& scenario, const World& world) {
  if (scenario.robots || !scenario.goal) return {};
  const double clearance = std::max(swarm_limits(scenario.swarm).radius,
                                    navigation::required_clearance(scenario.navigator));
  const Snapshot walls(world.map);
  const std::string why = walls.blocked_reason(*scenario.goal, clearance);
  const auto target =
      navigation::reachable_goal(walls, *scenario.goal, scenario.goal_tolerance, clearance);
  if (why.empty() || !target) return {};
  return {fmt::format("goal {}: the swarm is led to ({:.4g}, {:.4g}) µm, {:.3g} µm from it", why,
                      target->x, target->y, distance(*target, *scenario.goal))};
}

Issues validate(const Scenario& scenario, const World& world, const IsGiven& is_given) {
  Issues issues = validate_sensing(scenario);
  if (scenario.robots) issues.add(validate_robots(scenario));
  const bool is_complete = issues.empty() && (scenario.robots || scenario.goal);
  const auto lack = navigation::unsupported_reason(scenario.navigator, navigation_task(scenario));
  if (is_complete && !lack.empty())
    issues.add({"navigator.type", "navigator"}, fmt::format("this navigator needs {}", lack));
  issues.add_within("navigator", validate(scenario.navigator, navigation_task(scenario), *world.map,
                                          given_within(is_given, "navigator")));
  if (!scenario.robots)
    issues.add(validate_body(scenario, world));
  else if (issues.empty())
    issues.add(validate_robot_positions(scenario, *world.map));
  issues.add(validate_radar(scenario, world));
  return issues;
}

}  // namespace microswarm::experiment
