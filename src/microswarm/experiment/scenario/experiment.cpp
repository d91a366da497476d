// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/config/file_kind.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/input_folder.hpp"
#include "microswarm/experiment/scenario/fit_clearance.hpp"
#include "microswarm/experiment/scenario/validate.hpp"

namespace microswarm::experiment {
namespace {

/// Whether a key that others are validated against was misread. Then only reading errors are
/// reported.
bool misread_basis(const std::vector<std::string>& misread) {
  constexpr const char* basis[] = {"map",     "obstacles",        "swarm", "robots", "start",
                                   "goal_um", "goal_tolerance_um"};
  return std::ranges::any_of(
      basis, [&](const char* key) { return std::ranges::find(misread, key) != misread.end(); });
}

/// Top-level keys that the issues are about.
std::vector<std::string> top_keys(const Issues& issues) {
  std::vector<std::string> tops;
  for (const Issue& issue : issues)
    for (const std::string& key : issue.keys) tops.push_back(key.substr(0, key.find('.')));
  return tops;
}

/// Missing keys of a swarm of one body that do not depend on other keys.
Issues missing_places(const Scenario& scenario) {
  Issues issues;
  if (scenario.robots) return issues;
  if (!scenario.start) issues.add("start", "missing key 'start'");
  if (!scenario.goal) issues.add("goal_um", "missing key 'goal_um'");
  return issues;
}

/// Opens what was read with these issues.
Experiment open(Scenario scenario, const std::filesystem::path& base, const KeyLocations& keys,
                Issues issues) {
  const std::vector<std::string> misread = top_keys(issues);
  Issues more;
  Experiment opened{load_scene(std::move(scenario), base, more), {}, keys};
  opened.keys.add_notes(opened.scene.map.notes);
  if (more.empty() && !misread_basis(misread)) {
    opened.world = build_world(opened.scene);
    opened.keys.add_notes(fit_clearance(opened.scene.scenario, opened.world, keys.is_given()));
    more = validate(opened.scenario(), opened.world, keys.is_given());
  } else if (std::ranges::find(misread, "robots") == misread.end()) {
    more.add(missing_places(opened.scenario()));
  }
  more.drop(misread);
  issues.add(more);
  keys.require_none(issues);
  opened.keys.add_notes(goal_notes(opened.scenario(), opened.world));
  return opened;
}

}  // namespace

Experiment open_experiment(const std::filesystem::path& file, const Settings& settings,
                           std::optional<std::uint64_t> seed) {
  return open_experiment_text(read_file(file, max_yaml_bytes), file.string(), input_folder(file),
                              settings, seed);
}

Experiment open_experiment_text(std::string_view text, const std::string& name,
                                const std::filesystem::path& base, const Settings& settings,
                                std::optional<std::uint64_t> seed) {
  if (text.size() > max_yaml_bytes)
    throw InputError(
        name, fmt::format("{} bytes, a scenario has at most {}", text.size(), max_yaml_bytes));
  KeyLocations keys;
  Issues issues;
  auto scenario = read_yaml_text<Scenario>(text, name, settings, keys, issues);
  if (!issues.empty()) refuse_other_kind(text, name, "scenario");
  if (seed) scenario.seed = *seed;
  return open(std::move(scenario), base, keys, std::move(issues));
}

Experiment open_experiment(Scenario scenario, const std::filesystem::path& base,
                           const KeyLocations& keys) {
  return open(std::move(scenario), base, keys, {});
}

}  // namespace microswarm::experiment
