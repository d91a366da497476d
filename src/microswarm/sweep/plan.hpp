// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/sweep/sweep_file.hpp"

namespace microswarm {

/// What every trial of one combination of values and method has in common.
struct SweepCell {
  std::vector<std::string> values;  ///< one for each parameter of the grid
  std::string method;
  std::vector<std::string> settings;  ///< all, in the order in which they are applied
  Scenario scenario;                  ///< the tracks of its obstacles have their samples
  World world;                        ///< cells of the same walls share their map
  std::string input_hash;             ///< of scenario, map and tracks, as Scene::hash()
};

/// A sweep with all that the files it names held. The last parameter of the grid changes before the
/// first, and the method before all of them.
struct SweepPlan {
  Sweep sweep;
  std::string file;           ///< as given
  std::string scenario_text;  ///< of the scenario that all cells begin with
  YamlNode scenario_document;
  Notes notes;  ///< on former keys that were read
  std::vector<SweepCell> cells;

  /// Fingerprint of everything that results depend on.
  std::string hash() const;
};

/// Reads a sweep file and what it names, and makes the cells, on `jobs` threads (0: one a core).
/// Throws InputError, one line, for the first cell that cannot be.
SweepPlan load_sweep(const std::filesystem::path& file, int jobs = 0);

/// Throws InputError for the first cell that cannot be meant so; see check(Scenario).
void check(const SweepPlan& plan, int jobs = 0);

/// One trial of a sweep.
struct SweepTask {
  std::uint32_t cell = 0;
  std::uint32_t trial = 0;
};

}  // namespace microswarm
