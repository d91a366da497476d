// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/validate_radar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "microswarm/experiment/scenario/passages.hpp"
#include "microswarm/navigation/radar/wait_zone.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/world/map/map.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {
namespace {

/// A phased goal with its name and key.
struct Stage {
  Vec2 position;
  std::string name;
  std::string key;
};

std::vector<Stage> radar_stages(const Scenario& scenario, const navigation::RadarParams& radar) {
  std::vector<Stage> stages{{scenario.start->position, "start", "start"}};
  for (std::size_t i = 0; i < radar.waypoints.size(); ++i)
    stages.push_back({radar.waypoints[i], fmt::format("waypoint {}", i + 1),
                      fmt::format("navigator.waypoints_um.{}", i)});
  stages.push_back({*scenario.goal, "goal", "goal_um"});
  return stages;
}

Issues validate_legs(const std::vector<Stage>& stages, const Map& map) {
  Issues issues;
  for (std::size_t i = 1; i < stages.size(); ++i) {
    const Stage &a = stages[i - 1], &b = stages[i];
    if (!map.is_free(a.position, 0) || !map.is_free(b.position, 0)) continue;  // reported elsewhere
    if (map.is_free(Segment{a.position, b.position}, 0)) continue;
    issues.add(
        {b.key, a.key},
        fmt::format("the way from {} ({:.6g}, {:.6g}) to {} ({:.6g}, {:.6g}) µm crosses a wall",
                    a.name, a.position.x, a.position.y, b.name, b.position.x, b.position.y));
  }
  return issues;
}

/// Passages that the radar cannot enter, since it takes no direction in which its predictive swarm
/// comes nearer to a wall than d_f. Between two posts that step alone may lead through: then at
/// its middle, half of d_p from both ends, the way is at least `needed` wide.
Issues validate_passages(const Scenario& scenario, const navigation::RadarParams& radar,
                         const World& world) {
  const SwarmLimits swarm = swarm_limits(scenario.swarm);
  const Snapshot walls(world.map);
  const Map& map = *world.map;
  const Vec2 start = scenario.start->position;
  const double radius = swarm.radius - swarm.radius_variation;
  const double reach = radius + radar.safety_distance;
  const navigation::Aim aim =
      navigation::aim_at(walls, *scenario.goal, scenario.goal_tolerance, swarm.radius,
                         swarm.radius + radar.safety_distance);
  const double half = std::min(reach, 0.5 * radar.prediction_distance);
  // Nearer to a wall it leaves the start, and enters the goal.
  const double needed =
      std::min({std::sqrt(reach * reach - half * half), map.clearance(start), aim.clearance});
  Issues issues;
  if (needed <= swarm.radius || leads_to(map, start, aim.position, needed)) return issues;
  issues.add(
      "navigator.safety_distance_um",
      fmt::format("navigator.safety_distance_um is {:.4g}: the radar keeps {:.4g} µm from "
                  "walls, wider than the passages to the goal allow{}",
                  radar.safety_distance, reach, tightest_text(map, start, aim.position, reach)));
  return issues;
}

/// Why the valve in the zone never lets the swarm pass; empty if it does.
std::string never_opens(const navigation::WaitZone& area, const Valve& valve) {
  const bool opens = valve.max_gap >= valve.span ||    // then the valve is absent
                     valve.min_gap >= area.min_gap ||  // it is never too narrow
                     valve.max_gap > area.min_gap;
  if (opens) return {};
  return fmt::format("min_gap_um is {:.6g}, the valve in it opens to {:.6g} µm", area.min_gap,
                     valve.max_gap);
}

Issues validate_area(const navigation::WaitZone& area, const Scenario& scenario, const Map& map) {
  Issues issues;
  const Box b = map.bounds();
  const Body ground{Polygon{{b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}}, {}}};
  if (navigation::gap_between(Body{navigation::zone_outline(area)}, ground) > 0) {
    issues.add("centre_um", fmt::format("at ({:.6g}, {:.6g}) µm it is outside the map",
                                        area.centre.x, area.centre.y));
    return issues;
  }
  bool has_valve = false;
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    const auto* valve = std::get_if<Valve>(&scenario.obstacles[i].shape);
    const auto* still = std::get_if<Still>(&scenario.obstacles[i].motion);
    if (!valve || (still && !navigation::contains(area, still->position))) continue;
    has_valve = true;
    if (const std::string why = never_opens(area, *valve); still && !why.empty())
      issues.add("min_gap_um", fmt::format("{} (obstacle {})", why, i + 1));
  }
  if (!has_valve) issues.add("centre_um", "the middle of no valve is in it");
  return issues;
}

}  // namespace

Issues validate_radar_passages(const Scenario& scenario, const World& world) {
  const auto* radar = std::get_if<navigation::RadarParams>(&scenario.navigator);
  return radar ? validate_passages(scenario, *radar, world) : Issues();
}

Issues validate_radar(const Scenario& scenario, const World& world) {
  Issues issues;
  const auto* radar = std::get_if<navigation::RadarParams>(&scenario.navigator);
  if (!radar || !scenario.start || !scenario.goal) return issues;
  if (!radar->waypoints.empty())
    issues.add(validate_legs(radar_stages(scenario, *radar), *world.map));
  for (std::size_t i = 0; i < radar->wait_zones.size(); ++i)
    issues.add_within(fmt::format("navigator.wait_zones.{}", i),
                      validate_area(radar->wait_zones[i], scenario, *world.map),
                      fmt::format("wait zone {}", i + 1));
  return issues;
}

}  // namespace microswarm::experiment
