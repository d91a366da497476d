// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "microswarm/config/settings.hpp"

namespace microswarm {

/// A YAML text with values set, each on one line. Comments and the form of everything else stay. A
/// key that is not there is added to its map, a map that is not there is added in braces. Throws
/// InputError, with the lines to write by hand, if the text cannot be edited with certainty: other
/// values would change.
std::string edit_yaml(std::string_view text, std::string_view name,
                      std::span<const Setting> settings);

}  // namespace microswarm
