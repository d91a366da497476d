// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

struct Type;

/// Notes on the former keys read, one line each: "flight.yaml:12:3: 'margin_um' is now 'gap_um'".
using Notes = std::vector<std::string>;

/// Renames the former keys in a parsed document of this type and moves the keys listed in `moved`.
/// Lines and columns stay. A former key next to its current one is kept and becomes an error.
void use_present_keys(const Type& type, YamlNode& document, std::string_view name,
                      std::span<const MovedKey> moved, Notes& notes);

/// The same for a value of this type that is assigned to `key`; notes begin with `name` alone.
/// Throws InputError for a key in it that is now elsewhere. True if the value was changed.
bool use_present_keys_in_value(const Type& type, YamlNode& value, std::string_view name,
                               std::string_view key, std::span<const MovedKey> moved, Notes& notes);

}  // namespace microswarm
