// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/formats/map_parts.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// A scenario and the contents of its files: everything a run depends on.
struct Scene {
  Scenario scenario{};  ///< tracks of obstacles include their samples
  formats::MapParts map{};

  /// Fingerprint of the whole scene.
  std::string hash() const;
};

/// Reads the scenario's map, tracks and learned follower, relative to the folder `base`. Problems
/// with these or with an obstacle are added to `issues`; the scene is then unusable.
Scene load_scene(Scenario scenario, const std::filesystem::path& base, Issues& issues);
/// Same, but throws InputError with one line per issue.
Scene load_scene(Scenario scenario, const std::filesystem::path& base,
                 const KeyLocations& keys = {});

/// The navigator's task in a scenario.
navigation::Task navigation_task(const Scenario& scenario);

/// Builds the world of a scene. Throws InputError like Map.
World build_world(const Scene& scene);

}  // namespace microswarm::experiment
