// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "support/command.hpp"

namespace microswarm::cli {

/// Option `name` KEY=VALUE, which overrides values of a rig file.
Option add_rig_settings(Command command, const char* name, std::vector<std::string>& values);

}  // namespace microswarm::cli
