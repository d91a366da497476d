// SPDX-License-Identifier: Apache-2.0
#include "rig/rig_notes.hpp"

#include "support/cli.hpp"

namespace microswarm::cli {

void note_field(const rig::Rig& rig, const experiment::Scenario& scenario) {
  const std::string unusual = rig::unusual_field(rig, scenario);
  if (!unusual.empty()) note("note: {}: {}\n", rig::rig_name(rig), unusual);
}

}  // namespace microswarm::cli
