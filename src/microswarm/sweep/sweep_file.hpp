// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::sweep {

/// A scenario key and the values it takes, written as for `--set KEY=`.
struct SweepParameter {
  std::string key{};
  std::vector<std::string> values{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.key, plain("key", "Key of the scenario, such as swarm.radius_um.").needed());
    visit(self.values, plain("values", "Values; lists and mappings in quotes.").needed());
  }
};

/// A named group of settings; methods are compared with each other.
struct SweepMethod {
  std::string name{};
  std::vector<std::string> set{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the method.").needed());
    visit(self.set, plain("set", "Settings KEY=VALUE of the scenario."));
  }
};

/// A sweep: every combination of grid values and methods, `trials` times each.
struct Sweep {
  std::string name{};
  std::string description{};
  std::string scenario{};
  std::vector<std::string> set{};
  std::vector<SweepParameter> grid{};
  std::vector<SweepMethod> methods{};
  int trials = 1;
  std::optional<std::uint64_t> seed{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the sweep."));
    visit(self.description, plain("description", "Description of the sweep."));
    visit(self.scenario,
          plain("scenario", "Scenario file, from the sweep file's folder.").needed());
    visit(self.set, plain("set", "Settings KEY=VALUE of the scenarios of all cells."));
    visit(self.grid, plain("grid", "Parameters whose combinations are run."));
    visit(self.methods, plain("methods", "Methods compared in every combination."));
    visit(self.trials, plain("trials", 1, 1e6, "Trials of each cell: 0 to n - 1.").needed());
    visit(self.seed, plain("seed", "Seed in place of the scenario's."));
  }
};

/// Limits on the cells and on the total number of trials of a sweep.
inline constexpr std::size_t max_cells = 100'000;
inline constexpr std::size_t max_trials = 10'000'000;

/// Reads a sweep file. Without methods there is one, called "default". Throws InputError, one line,
/// also for empty values, duplicate keys, values or names, and more cells or trials than allowed.
Sweep read_sweep(const std::filesystem::path& file);

/// The same from a text; `name` stands for the file in messages.
Sweep read_sweep_text(std::string_view text, const std::string& name);

/// The same of a sweep that was put together by a program, called `name` in messages. Its settings
/// and its grid may set the seed, which a file may not.
Sweep checked_sweep(Sweep sweep, const std::string& name);

/// Number of combinations of a sweep's values and methods.
std::size_t cell_count(const Sweep& sweep);

}  // namespace microswarm::sweep
