// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace microswarm {

/// Texts KEY=VALUE that change values after a file was read, and the option of the command line
/// that gave them, as messages name it.
struct Settings {
  Settings() = default;
  Settings(std::initializer_list<std::string> list) : texts(list) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a plain list is one of --set
  Settings(std::vector<std::string> list, std::string from = "--set")
      : texts(std::move(list)), option(std::move(from)) {}

  std::vector<std::string> texts;
  std::string option = "--set";
};

}  // namespace microswarm
