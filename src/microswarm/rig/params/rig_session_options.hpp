// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "microswarm/config/settings.hpp"

namespace microswarm::rig {

/// Options for opening a scenario with or without a simulated rig.
struct RigSessionOptions {
  Settings settings{};          ///< of the scenario
  std::filesystem::path rig{};  ///< rig file; empty: no rig
  Settings rig_settings{};
};

}  // namespace microswarm::rig
