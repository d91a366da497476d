// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "microswarm/config/key_locations.hpp"
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

/// Reads the scenario's map, tracks and learned follower, relative to the folder `base`. What is
/// wrong with them or with an obstacle goes into `issues`; then the scene is of no use.
Scene load_scene(Scenario scenario, const std::filesystem::path& base, Issues& issues);
/// The same; throws InputError with a line for each issue.
Scene load_scene(Scenario scenario, const std::filesystem::path& base,
                 const KeyLocations& keys = {});

/// What a scenario tells its navigator.
Task task_of(const Scenario& scenario);

/// Builds the world of a scene. Throws InputError as Map does.
World build_world(const Scene& scene);

}  // namespace microswarm
