// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/config/type.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"

namespace microswarm {

inline constexpr std::size_t max_yaml_bytes = 16 << 20;

/// Reads YAML text into the value and returns the document with its current keys. Values not given
/// by the text are kept. Throws InputError for text that is no YAML. Mistakes in keys and values go
/// into `issues`; the overload without it throws them, one line each. A value with a mistake is
/// unchanged or partly read.
YamlNode read_yaml(const Type& type, void* value, std::string_view text, std::string_view name,
                   Issues& issues, Notes& notes, std::span<const MovedKey> moved = {});
YamlNode read_yaml(const Type& type, void* value, std::string_view text, std::string_view name,
                   std::span<const MovedKey> moved = {});

/// Moved keys that T lists.
template <class T>
constexpr std::span<const MovedKey> list_moved_keys() {
  if constexpr (requires { T::moved_keys; })
    return T::moved_keys;
  else
    return {};
}

/// Type-erased implementation of `set_value<T>`.
std::optional<Setting> set_value(const Type& type, void* value, const Setting& setting,
                                 std::string_view option, std::span<const MovedKey> moved,
                                 Notes& notes);

/// Parameter struct from YAML text; `name` stands for the file in messages. Strict: throws
/// InputError with a line for each unknown or missing key, wrong type, number that is out of range
/// or not finite, and unknown word, e.g. "NAME:LINE:COLUMN: unknown key 'stpe_um', did you mean
/// 'step_um'?".
template <HasFields T>
T read_yaml_text(std::string_view text, std::string_view name) {
  T value{};
  read_yaml(type_of<T>(), &value, text, name, list_moved_keys<T>());
  return value;
}

/// Parameter struct from a YAML file; messages name the path as given.
template <HasFields T>
T read_yaml_file(const std::filesystem::path& path) {
  return read_yaml_text<T>(read_file(path, max_yaml_bytes), path.string());
}

/// Applies one assignment, which `option` gave. Setting a variant's `type` to another
/// alternative resets it to that alternative's defaults; its other keys can only be set once it is
/// chosen. Issues are as in a file, with the location "--set planner.stpe_um", and leave `value`
/// unchanged. Returns the assignment with its current keys; nothing for a key that no longer has a
/// meaning.
template <HasFields T>
std::optional<Setting> set_value(T& value, const Setting& setting, std::string_view option,
                                 Notes& notes) {
  T changed = value;
  auto present = set_value(type_of<T>(), &changed, setting, option, list_moved_keys<T>(), notes);
  value = std::move(changed);
  return present;
}
/// The same for KEY=VALUE.
template <HasFields T>
void set_value(T& value, std::string_view text, std::string_view option = {}) {
  Notes notes;
  set_value(value, parse_setting(text, option), option, notes);
}

/// The order in which assignments are applied, as indices: as given, but one that chooses the
/// `type` of a part comes before those that set something in that part, which it might drop. So
/// the order of keys does not matter; of two assignments to one key the later one counts.
std::vector<std::size_t> types_first(std::span<const Setting> settings);

/// Applies assignments, types first. Returns notes on former keys.
template <HasFields T>
Notes set_values(T& value, const Settings& assignments) {
  Notes notes;
  for (const std::size_t i : types_first(assignments.list))
    set_value(value, assignments.list[i], assignments.option, notes);
  return notes;
}

/// Parameter struct from YAML text, with assignments applied after it, types first. Mistakes in
/// keys and values go into `issues`; `locations` receives the location of each key and the notes on
/// former keys.
template <HasFields T>
T read_yaml_text(std::string_view text, const std::string& name, const Settings& assignments,
                 KeyLocations& locations, Issues& issues) {
  T value{};
  Notes notes;
  YamlNode document =
      read_yaml(type_of<T>(), &value, text, name, issues, notes, list_moved_keys<T>());
  Settings present(std::vector<Setting>(), assignments.option);
  for (const std::size_t i : types_first(assignments.list)) {
    try {
      auto applied = set_value(value, assignments.list[i], assignments.option, notes);
      if (applied) present.list.push_back(std::move(*applied));
    } catch (const InputError& error) {
      issues.add(error.issues());
    }
  }
  locations = find_locations(std::move(document), name, std::move(present), std::move(notes));
  return value;
}

/// The same from a file; messages name the path as given.
template <HasFields T>
T read_yaml_file(const std::filesystem::path& path, const Settings& assignments,
                 KeyLocations& locations, Issues& issues) {
  return read_yaml_text<T>(read_file(path, max_yaml_bytes), path.string(), assignments, locations,
                           issues);
}

/// The same, but throws InputError with a line for each mistake.
template <HasFields T>
T read_yaml_file(const std::filesystem::path& path, const Settings& assignments,
                 KeyLocations& locations) {
  Issues issues;
  T value = read_yaml_file<T>(path, assignments, locations, issues);
  if (!issues.empty()) throw InputError(issues);
  return value;
}

}  // namespace microswarm
