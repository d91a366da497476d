// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calls.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "setting_list.hpp"

namespace microswarm::python {

/// A scenario as text and later settings, opened in the same way as by the command line.
struct ScenarioText {
  std::string text;
  std::string name;
  std::filesystem::path base;
  Given settings{};
  experiment::Scenario value{};
  experiment::Scenario unset{};  ///< without the settings

  static ScenarioText load(const std::string& file) {
    const std::filesystem::path path(file);
    return of(read_file(path, max_yaml_bytes), file, std::filesystem::absolute(path).parent_path());
  }
  static ScenarioText of(std::string text, std::string name, std::filesystem::path base) {
    ScenarioText made{std::move(text), std::move(name), std::move(base)};
    KeyLocations keys;
    Issues issues;
    made.value = read_yaml_text<experiment::Scenario>(made.text, made.name, {}, keys, issues);
    if (!issues.empty()) throw InputError(issues);
    warn(keys.notes());
    made.unset = made.value;
    return made;
  }
  void set(const Setting& setting) {
    Notes notes;
    const auto present = set_value(value, setting, "", notes);
    warn(notes);
    if (!present) return;
    const std::string now = to_json_text(value);
    settings = with_setting(settings, *present, [&](const Given& list) {
      try {
        experiment::Scenario other = unset;
        set_values(other, to_settings(list));
        return to_json_text(other) == now;
      } catch (const InputError&) {
        return false;
      }
    });
  }
  experiment::Experiment open(std::optional<std::uint64_t> seed = {}) const {
    return experiment::open_experiment_text(text, name, base, to_settings(settings), seed);
  }
};

}  // namespace microswarm::python
