// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// A validated scenario with its world, ready to run.
struct Experiment {
  Scene scene{};
  World world{};
  KeyLocations keys{};  ///< of the scenario file

  const Scenario& scenario() const { return scene.scenario; }
};

/// Opens a scenario file. `settings` are applied after the file; the seed is applied last. Throws
/// InputError with one line per issue: of a key, a value, a referenced file, or of their
/// combination.
Experiment open_experiment(const std::filesystem::path& file, const Settings& settings = {},
                           std::optional<std::uint64_t> seed = std::nullopt);

/// The same from the text of a scenario file, at most 16 MB; `name` is its name in messages, and
/// file names in it are relative to `base`.
Experiment open_experiment_text(std::string_view text, const std::string& name,
                                const std::filesystem::path& base, const Settings& settings = {},
                                std::optional<std::uint64_t> seed = std::nullopt);

/// Opens a scenario that was already read; file names are relative to `base`.
Experiment open_experiment(Scenario scenario, const std::filesystem::path& base,
                           const KeyLocations& keys = {});

}  // namespace microswarm::experiment
