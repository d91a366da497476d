// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/fields.hpp"

namespace microswarm {

struct Type;

/// Notes on the former keys read, one line each: "flight.yaml:12:3: 'margin_um' is now 'gap_um'".
using Notes = std::vector<std::string>;

/// Renames the former keys in a parsed document of this type and moves the keys listed in `moved`.
/// Lines and columns stay. A former key beside its present one is left alone, so it is reported as
/// unknown.
void use_present_keys(const Type& type, YamlNode& document, std::string_view name,
                      std::span<const MovedKey> moved, Notes& notes);

/// The assignment "KEY=VALUE" with the present key; `value` gives the alternative that a variant
/// holds.
std::string with_present_key(const Type& type, const void* value, std::string_view assignment,
                             std::span<const MovedKey> moved);

/// Note on an assignment whose key was renamed.
std::string renaming_note(std::string_view option, std::string_view assignment,
                          std::string_view present);

}  // namespace microswarm
