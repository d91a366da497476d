// SPDX-License-Identifier: Apache-2.0
#include "rig/rig_notes.hpp"

#include "support/cli.hpp"

namespace microswarm::cli {

void note_field(const Rig& rig, const Scenario& scenario) {
  const std::string unusual = unusual_field(rig, scenario);
  if (!unusual.empty()) note("note: {}: {}\n", rig_name(rig), unusual);
}

}  // namespace microswarm::cli
