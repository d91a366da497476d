// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/core/hash.hpp"
#include "microswarm/experiment/scenario/radar_check.hpp"
#include "microswarm/experiment/scenario/robot_check.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/tracks.hpp"
#include "microswarm/navigation/following/follower_model.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/world/connectivity/passage.hpp"

namespace microswarm {

namespace {

constexpr std::uint64_t max_model_bytes = 1 << 20;

Places obstacle_in(const Places& where, std::size_t i) {
  return where.within(fmt::format("obstacles.{}", i), fmt::format("obstacle {}", i + 1));
}

/// Fills in the samples of all tracks; a file is read once.
void load_tracks(std::vector<Obstacle>& obstacles, const std::filesystem::path& base,
                 const Places& where) {
  std::map<std::filesystem::path, Tracks> files;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    auto* track = std::get_if<Track>(&obstacles[i].motion);
    if (!track) continue;
    const Places motion = obstacle_in(where, i).within("motion");
    if (track->file.empty()) throw motion.error("file", "missing key 'file' of its track");
    const std::filesystem::path path = base / track->file;
    auto file = files.find(path);
    if (file == files.end()) file = files.emplace(path, read_tracks(path)).first;
    const auto samples = file->second.find(track->id);
    if (samples == file->second.end())
      throw motion.error("id", fmt::format("{} has no id '{}'", path.string(), track->id));
    track->samples = std::make_shared<const Samples>(samples->second);
  }
}

/// Reads the model of a learned follower that the navigator names.
void load_follower(NavigatorParams& navigator, const std::filesystem::path& base) {
  FollowerParams* follower = follower_of(navigator);
  if (!follower || follower->model.empty()) return;
  const std::filesystem::path path = base / follower->model;
  follower->loaded = std::make_shared<const FollowerModel>(
      parse_follower_model(read_file(path, max_model_bytes), path.string()));
}

void hash_points(Hash& hash, const std::vector<Vec2>& points) {
  hash.value(static_cast<std::uint64_t>(points.size()));
  for (const Vec2 p : points) hash.value(p.x), hash.value(p.y);
}

void hash_map(Hash& hash, const MapParts& map) {
  hash_points(hash, {map.bounds.lo, map.bounds.hi});
  hash.value(static_cast<std::uint64_t>(map.walls.size()));
  for (const Polygon& wall : map.walls) {
    hash_points(hash, wall.outer);
    hash.value(static_cast<std::uint64_t>(wall.holes.size()));
    for (const auto& hole : wall.holes) hash_points(hash, hole);
  }
  for (const Disc& disc : map.discs) {
    hash_points(hash, {disc.centre});
    hash.value(disc.radius);
  }
}

}  // namespace

template const Type& type_of<Scenario>();

Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& settings,
                       Places& places) {
  return read_yaml_file<Scenario>(file, settings, places);
}

Scenario read_scenario(const std::filesystem::path& file,
                       const std::vector<std::string>& settings) {
  Places places;
  return read_scenario(file, settings, places);
}

std::string scenario_text(const Scenario& scenario) {
  Scenario out = scenario;
  out.navigator = in_effect(out.navigator);
  return to_yaml(out);
}

std::string Scene::hash() const {
  Hash hash;
  hash.text(scenario_text(scenario));
  hash_map(hash, map);
  for (const Obstacle& obstacle : scenario.obstacles) {
    const auto* track = std::get_if<Track>(&obstacle.motion);
    if (!track || !track->samples) continue;
    for (const double t : track->samples->times) hash.value(t);
    hash_points(hash, track->samples->points);
  }
  if (const FollowerParams* follower = follower_of(scenario.navigator);
      follower && follower->loaded)
    hash.text(follower_model_text(*follower->loaded));
  return hash.hex();
}

Scene load_scene(Scenario scenario, const std::filesystem::path& base, const Places& where) {
  load_tracks(scenario.obstacles, base, where);
  load_follower(scenario.navigator, base);
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    check(scenario.obstacles[i], obstacle_in(where, i));
  MapParts map = read_map_parts(scenario.map, base, where);
  return {std::move(scenario), std::move(map)};
}

World build_world(const Scene& scene) {
  const MapParts& parts = scene.map;
  return {std::make_shared<const Map>(parts.bounds, parts.walls, parts.discs),
          scene.scenario.obstacles};
}

void check_way(const Map& map, Vec2 start, Vec2 goal, double radius, const Places& where) {
  const WidestPath way = widest_path(map, start, goal, radius);
  if (!way.found && !connected(map, start, goal))
    throw where.error("goal_um", "goal is cut off from the start by walls");
  // A way that the search may have missed for its resolution is not denied.
  if (way.clearance + 1.5 * way.resolution >= radius) return;
  throw where.error(
      {"swarm.radius_um", "swarm", "goal_um"},
      fmt::format(
          "swarm is {:.4g} µm wide, wider than every passage to the goal: the widest is about "
          "{:.3g} µm, at ({:.4g}, {:.4g}) µm",
          2 * radius, 2 * way.clearance, way.tightest.x, way.tightest.y));
}

namespace {

// A navigator that takes what it sees for too old holds for ever.
void check_sensing(const Scenario& scenario, const Places& where) {
  const double timeout = frame_timeout_of(scenario.navigator);
  const double delay = scenario.sensing.observation_delay;
  if (delay <= timeout) return;
  throw where.error(
      {"sensing.observation_delay_s", "navigator.frame_timeout_s"},
      fmt::format("sensing.observation_delay_s is {:.4g}, more than navigator.frame_timeout_s, "
                  "{:.4g}: every frame would be too old",
                  delay, timeout));
}

InputError goal_error(const std::string& why, const Scenario& scenario, const Places& where) {
  return where.error("goal_um",
                     fmt::format("goal {}, and {:.3g} of goal_tolerance_um is only {:.4g} µm", why,
                                 aim_share, aim_share * scenario.goal_tolerance));
}

// What the swarm fits through, its navigator may still refuse.
void check_margin(const Scenario& scenario, const World& world, const Places& where) {
  const double margin = margin_of(scenario.navigator);
  const Snapshot walls(world.map);
  const auto target = reachable_goal(walls, *scenario.goal, scenario.goal_tolerance, margin);
  if (!target)
    throw goal_error(walls.why_blocked(*scenario.goal, margin) + " (navigator.margin_um)", scenario,
                     where);
  const WidestPath way = widest_path(*world.map, scenario.start->position, *target, margin);
  // A start that is nearer to a wall is let go: the navigator leads away from there.
  const double needed = std::min(margin, world.map->clearance(scenario.start->position));
  if (way.clearance + 1.5 * way.resolution >= needed) return;
  if (!way.found)
    throw where.error(
        "navigator.margin_um",
        fmt::format("navigator.margin_um is {:.4g}, wider than the passages to the goal allow",
                    margin));
  throw where.error(
      "navigator.margin_um",
      fmt::format(
          "navigator.margin_um is {:.4g}, wider than the passages to the goal allow: about {:.3g} "
          "µm are left at ({:.4g}, {:.4g}) µm",
          margin, way.clearance, way.tightest.x, way.tightest.y));
}

void check_body(const Scenario& scenario, const World& world, const Places& where) {
  if (!scenario.start) throw where.error("start", "missing key 'start'");
  const double radius = limits_of(scenario.swarm).radius;
  if (const auto why = world.at(0).why_blocked(scenario.start->position, radius); !why.empty())
    throw where.error("start", fmt::format("start {}", why));
  // The swarm's centre may stop anywhere within the tolerance.
  const Snapshot walls(world.map);
  const auto target = reachable_goal(walls, *scenario.goal, scenario.goal_tolerance, radius);
  if (!target) throw goal_error(walls.why_blocked(*scenario.goal, radius), scenario, where);
  check_way(*world.map, scenario.start->position, *target, radius, where);
  check_margin(scenario, world, where);
}

}  // namespace

Task task_of(const Scenario& scenario) {
  return {.swarm = limits_of(scenario.swarm),
          .robots = scenario.robots,
          .goal = scenario.goal,
          .goal_tolerance = scenario.goal_tolerance,
          .tick = scenario.tick};
}

void check(const Scenario& scenario, const World& world, const Places& where) {
  check_sensing(scenario, where);
  if (scenario.robots) check_robots(scenario, where);
  if (!scenario.robots && !scenario.goal) throw where.error("goal_um", "missing key 'goal_um'");
  if (const auto lack = what_it_lacks(scenario.navigator, task_of(scenario)); !lack.empty())
    throw where.error({"navigator.type", "navigator"},
                      fmt::format("this navigator needs {}", lack));
  check_navigator(scenario.navigator, task_of(scenario), *world.map, where);
  scenario.robots ? check_robot_places(scenario, *world.map, where)
                  : check_body(scenario, world, where);
  check_radar(scenario, world, where);
}

}  // namespace microswarm
