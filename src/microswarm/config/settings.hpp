// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace microswarm {

/// Assignments KEY=VALUE applied after a file is read, and the command-line option that gave them,
/// for messages.
struct Settings {
  Settings() = default;
  Settings(std::initializer_list<std::string> list) : texts(list) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a plain list belongs to --set
  Settings(std::vector<std::string> list, std::string from = "--set")
      : texts(std::move(list)), option(std::move(from)) {}

  std::vector<std::string> texts;
  std::string option = "--set";
};

}  // namespace microswarm
