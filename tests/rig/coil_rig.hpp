// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/rig/params/rig_params.hpp"
#include "tests/files.hpp"

namespace microswarm::test {

/// A simulated rig of three Helmholtz pairs, whose `drives` are a list of YAML.
inline rig::Rig coil_rig(const Folder& folder, const std::string& drives,
                         const Settings& settings = {}) {
  folder.with("coils.yaml", "coils: {type: helmholtz}\ndrives: " + drives + "\n");
  return rig::read_rig(folder.with("rig.yaml", "coils: coils.yaml\n"), settings);
}

}  // namespace microswarm::test
