// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/scene.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/tracks.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm::experiment {
namespace {

constexpr std::uint64_t max_model_bytes = 1 << 20;

/// Cache of track files, each read once.
class TrackFiles {
 public:
  explicit TrackFiles(std::filesystem::path base) : base_(std::move(base)) {}

  /// Loads the samples of a track.
  Issues load(Track& track) {
    Issues issues;
    if (track.file.empty()) {
      issues.add("file", "missing key 'file' of its track");
      return issues;
    }
    const std::filesystem::path path = base_ / track.file;
    auto file = files_.find(path);
    if (file == files_.end()) file = files_.emplace(path, formats::read_tracks(path)).first;
    const auto samples = file->second.find(track.id);
    if (samples == file->second.end())
      issues.add("id", fmt::format("{} has no id '{}'", path.string(), track.id));
    else
      track.samples = std::make_shared<const Samples>(samples->second);
    return issues;
  }

 private:
  std::filesystem::path base_;
  std::map<std::filesystem::path, formats::Tracks> files_;
};

/// Loads the obstacles' tracks, then validates each obstacle.
Issues load_obstacles(std::vector<Obstacle>& obstacles, const std::filesystem::path& base) {
  Issues issues;
  TrackFiles files(base);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    Issues of_obstacle;
    const std::size_t before = issues.size();
    if (auto* track = find_track(obstacles[i].motion))
      attempt(issues, fmt::format("obstacles.{}.motion.file", i),
              [&] { of_obstacle.add_within("motion", files.load(*track)); });
    if (of_obstacle.empty() && issues.size() == before) of_obstacle = validate(obstacles[i]);
    issues.add_within(fmt::format("obstacles.{}", i), of_obstacle,
                      fmt::format("obstacle {}", i + 1));
  }
  return issues;
}

/// Reads the navigator's learned follower model, if it has one.
void load_follower(navigation::NavigatorParams& navigator, const std::filesystem::path& base) {
  navigation::FollowerParams* follower = navigation::find_follower(navigator);
  if (!follower || follower->model.empty()) return;
  const std::filesystem::path path = base / follower->model;
  follower->loaded = std::make_shared<const navigation::FollowerModel>(
      navigation::parse_follower_model(read_file(path, max_model_bytes), path.string()));
}

void hash_points(Hash& hash, const std::vector<Vec2>& points) {
  hash.value(static_cast<std::uint64_t>(points.size()));
  for (const Vec2 p : points) hash.value(p.x), hash.value(p.y);
}

void hash_map(Hash& hash, const formats::MapParts& map) {
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

std::string Scene::hash() const {
  Hash hash;
  hash.text(scenario_text(scenario));
  hash_map(hash, map);
  for (const Obstacle& obstacle : scenario.obstacles) {
    const auto* track = find_track(obstacle.motion);
    if (!track || !track->samples) continue;
    for (const double t : track->samples->times) hash.value(t);
    hash_points(hash, track->samples->points);
  }
  if (const navigation::FollowerParams* follower = navigation::find_follower(scenario.navigator);
      follower && follower->loaded)
    hash.text(navigation::follower_model_text(*follower->loaded));
  return hash.hex();
}

Scene load_scene(Scenario scenario, const std::filesystem::path& base, Issues& issues) {
  issues.add(load_obstacles(scenario.obstacles, base));
  attempt(issues, "navigator.follower.model", [&] { load_follower(scenario.navigator, base); });
  formats::MapParts map = formats::read_map_parts(scenario.map, base, issues);
  return {std::move(scenario), std::move(map)};
}

Scene load_scene(Scenario scenario, const std::filesystem::path& base, const KeyLocations& keys) {
  Issues issues;
  Scene scene = load_scene(std::move(scenario), base, issues);
  keys.require_none(issues);
  return scene;
}

World build_world(const Scene& scene) {
  const formats::MapParts& parts = scene.map;
  return {std::make_shared<const Map>(parts.bounds, parts.walls, parts.discs),
          scene.scenario.obstacles};
}

navigation::Task navigation_task(const Scenario& scenario) {
  return {.swarm = swarm_limits(scenario.swarm),
          .robots = scenario.robots,
          .goal = scenario.goal,
          .goal_tolerance = scenario.goal_tolerance,
          .tick = scenario.tick,
          .frame_timeout = scenario.sensing.frame_timeout};
}

}  // namespace microswarm::experiment
