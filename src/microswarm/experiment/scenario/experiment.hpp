// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// A scenario that was read, loaded and found right: ready to run.
struct Experiment {
  Scene scene;
  World world;
  KeyLocations keys;  ///< of the scenario's file

  const Scenario& scenario() const { return scene.scenario; }
};

/// Opens a scenario's file; `settings` are `key.path=value` texts, as from --set, applied after it,
/// then the seed. Throws InputError with a line for each thing wrong: with a key, a value, a file
/// that it names, or with what they mean together.
Experiment open_experiment(const std::filesystem::path& file,
                           const std::vector<std::string>& settings = {},
                           std::optional<std::uint64_t> seed = std::nullopt);

/// The same of a scenario that was read, with the files it names relative to `base`.
Experiment open_experiment(Scenario scenario, const std::filesystem::path& base,
                           const KeyLocations& keys = {});

}  // namespace microswarm
