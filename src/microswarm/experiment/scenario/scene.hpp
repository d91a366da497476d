// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "microswarm/core/places.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/formats/map_parts.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// A scenario and what the files that it names held: all that a run depends on.
struct Scene {
  Scenario scenario;  ///< the tracks of its obstacles have their samples
  MapParts map;

  /// Fingerprint of all of it.
  std::string hash() const;
};

/// Reads the scenario's map, tracks and learned follower, relative to the folder `base`. Throws
/// InputError for a file or an obstacle that makes no sense; `where` knows the scenario's keys.
Scene load_scene(Scenario scenario, const std::filesystem::path& base, const Places& where = {});

/// What a scenario tells its navigator.
Task task_of(const Scenario& scenario);

/// Builds the world of a scene. Throws InputError as Map does.
World build_world(const Scene& scene);

/// Throws InputError, one line, when the run cannot be meant so: the start or the goal in a wall
/// ("start is 12 µm inside wall 3"), the swarm wider than every passage, the goal cut off from the
/// start, no way that keeps the navigator's margin, or a navigator that would never get on. `where`
/// knows the scenario's keys, or is a name for it. Robots and their goals are looked at one by one.
void check(const Scenario& scenario, const World& world, const Places& where);

/// The last two of these complaints alone: between two free points of a map, for a swarm of
/// `radius` [µm].
void check_way(const Map& map, Vec2 start, Vec2 goal, double radius, const Places& where);

}  // namespace microswarm
