// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/sweep/sweep_file.hpp"

namespace microswarm::sweep {

/// One combination of grid values and method, shared by its trials.
struct SweepCell {
  std::vector<std::string> values{};  ///< one per grid parameter
  std::string method{};
  std::vector<Setting> settings{};  ///< all, in order of application
  experiment::Scenario scenario{};  ///< with the samples of its tracks
  World world{};                    ///< cells with the same walls share their map
  Notes notes{};                    ///< of former keys in the settings, and of the map
  std::string input_hash{};         ///< of scenario, map and tracks, as Scene::hash()
};

/// A sweep with the contents of all files it names. Cells are ordered with the method varying
/// fastest, then the last grid parameter.
struct SweepPlan {
  Sweep sweep{};
  std::string file{};           ///< name as given
  std::string scenario_text{};  ///< of the base scenario
  YamlNode scenario_document{};
  Notes notes{};  ///< of former keys that were read, and of maps
  std::vector<SweepCell> cells{};

  /// Fingerprint of everything the results depend on.
  std::string hash() const;
};

/// The text of a base scenario; `name` is its name in messages, and file names in it are relative
/// to `folder`.
struct SweepBase {
  std::string text{};
  std::string name{};
  std::filesystem::path folder{};
};

/// Builds the cells of a checked sweep on `jobs` threads (0: one per core); `name` is the
/// sweep's name in messages. Throws InputError, one line, for the first invalid cell. If stopped,
/// there are no cells.
SweepPlan plan_sweep(Sweep sweep, const std::string& name, const SweepBase& base, int jobs = 0,
                     const Stop& stop = {});

/// The same of a sweep file and the files it names.
SweepPlan load_sweep(const std::filesystem::path& file, int jobs = 0, const Stop& stop = {});

/// Validates every cell until stopped; throws InputError for the first invalid one. See
/// check(Scenario).
void check(const SweepPlan& plan, int jobs = 0, const Stop& stop = {});

/// One trial of a sweep.
struct SweepTask {
  std::uint32_t cell = 0;
  std::uint32_t trial = 0;
};

}  // namespace microswarm::sweep
