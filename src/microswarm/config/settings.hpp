// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace microswarm {

/// An assignment to a key: keys joined by dots, list entries by index, and a value as in a file
/// (text needs no quotes).
struct Setting {
  std::string key{};
  std::string value{};

  bool operator==(const Setting&) const = default;
};

/// "KEY=VALUE".
std::string to_string(const Setting& setting);
/// Splits KEY=VALUE. Throws InputError, which names the option, for a text that is none.
Setting parse_setting(std::string_view text, std::string_view option = {});

/// Assignments applied after a file is read, and the command-line option that gave them, for the
/// locations of issues. Without an option a location is the key alone.
struct Settings {
  Settings() = default;
  /// From KEY=VALUE each; throws InputError for a text that is none.
  Settings(std::initializer_list<std::string> texts)
      : Settings(std::vector<std::string>(texts), {}) {}
  Settings(const std::vector<std::string>& texts, std::string from);
  Settings(std::vector<Setting> settings, std::string from)
      : list(std::move(settings)), option(std::move(from)) {}

  bool empty() const { return list.empty(); }
  /// KEY=VALUE each.
  std::vector<std::string> texts() const;

  std::vector<Setting> list{};
  std::string option{};
};

/// Place of an issue in an assignment: "--set planner.step_um", or the key alone without an option.
std::string setting_location(std::string_view option, std::string_view key);

}  // namespace microswarm
