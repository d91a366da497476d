// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/core/execution/durations.hpp"
#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::cli {

/// Warns on stderr if the rig's kind of field is not the swarm's usual one.
void note_field(const Rig& rig, const Scenario& scenario);

/// Formats times [s] as "1.2 / 3.4 / 5.6 ms": p50, p95 and p99.
std::string quantiles(const Durations& times);

}  // namespace microswarm::cli
