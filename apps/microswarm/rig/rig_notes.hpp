// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::cli {

/// Warns on stderr if the rig's kind of field is not the swarm's usual one.
void note_field(const rig::Rig& rig, const experiment::Scenario& scenario);

}  // namespace microswarm::cli
