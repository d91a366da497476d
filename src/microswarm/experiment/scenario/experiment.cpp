// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/scenario/validate.hpp"

namespace microswarm {
namespace {

/// Whether a key that others are validated against was misread. Then only reading errors are
/// reported.
bool misread_basis(const Mistakes& mistakes) {
  constexpr const char* basis[] = {"map",     "obstacles",        "swarm", "robots", "start",
                                   "goal_um", "goal_tolerance_um"};
  return std::ranges::any_of(basis, [&](const char* key) {
    return std::ranges::find(mistakes.keys, key) != mistakes.keys.end();
  });
}

Experiment open(Scenario scenario, const std::filesystem::path& base, const KeyLocations& keys,
                Mistakes mistakes) {
  Issues issues;
  Experiment opened{load_scene(std::move(scenario), base, issues), {}, keys};
  if (issues.empty() && !misread_basis(mistakes)) {
    opened.world = build_world(opened.scene);
    issues = validate(opened.scenario(), opened.world, keys.is_given());
  }
  issues.drop(mistakes.keys);
  for (const Issue& issue : issues) mistakes.lines.push_back(keys.line(issue));
  mistakes.require_none();
  return opened;
}

}  // namespace

Experiment open_experiment(const std::filesystem::path& file,
                           const std::vector<std::string>& settings,
                           std::optional<std::uint64_t> seed) {
  return open_experiment_text(read_file(file, max_yaml_bytes), file.string(), file.parent_path(),
                              settings, seed);
}

Experiment open_experiment_text(std::string_view text, const std::string& name,
                                const std::filesystem::path& base,
                                const std::vector<std::string>& settings,
                                std::optional<std::uint64_t> seed) {
  if (text.size() > max_yaml_bytes)
    throw InputError(
        fmt::format("{}: {} bytes, a scenario has at most {}", name, text.size(), max_yaml_bytes));
  KeyLocations keys;
  Mistakes mistakes;
  auto scenario = read_yaml_text<Scenario>(text, name, settings, keys, mistakes);
  if (seed) scenario.seed = *seed;
  return open(std::move(scenario), base, keys, std::move(mistakes));
}

Experiment open_experiment(Scenario scenario, const std::filesystem::path& base,
                           const KeyLocations& keys) {
  return open(std::move(scenario), base, keys, {});
}

}  // namespace microswarm
