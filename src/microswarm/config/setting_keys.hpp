// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/type.hpp"

namespace microswarm {

/// A key that `--set KEY=VALUE` changes.
struct SettingKey {
  std::string key{};                      ///< full key, joined by dots
  std::string_view doc{};                 ///< its meaning
  std::vector<std::string_view> words{};  ///< its values, if they are words
};

/// All keys of a type that have a value, in the order of declaration, for shells that complete
/// them. The alternatives of a variant follow its key `type`; a key of several alternatives is
/// listed once, with the words of all. What is within a list is left out.
std::vector<SettingKey> setting_keys(const Type& type);

}  // namespace microswarm
