// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/config/settings.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/places.hpp"

namespace microswarm {

/// Where the keys of a document stand: "NAME:LINE:COLUMN" of their values. A key that one of the
/// assignments has set, in whole or in part, or whose alternative it has chosen, stands
/// there: "--set KEY".
Places places_of(YamlNode document, const std::string& name, Settings assignments);

}  // namespace microswarm
