// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "microswarm/core/durations.hpp"
#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::cli {

/// Says on stderr when the rig's kind of field is not the swarm's usual one.
void note_field(const Rig& rig, const Scenario& scenario);

/// Times [s] for people: "1.2 / 3.4 / 5.6 ms", p50, p95 and p99.
std::string quantiles(const Durations& times);

}  // namespace microswarm::cli
