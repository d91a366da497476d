// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "microswarm/experiment/session/session.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"
#include "microswarm/rig/params/rig_session_options.hpp"
#include "microswarm/rig/watch/map_check.hpp"

namespace microswarm::rig {

/// Opens a session through a simulated rig, as fast as possible. Throws InputError if rig and
/// scenario do not fit, or if the coils cannot hold the field.
std::unique_ptr<experiment::Session> open_on_rig(const RigExperiment& on, std::uint32_t trial = 0);

/// Compares the scenario's map with the first picture of the rig's simulated camera, as a run
/// compares it with that of its camera.
MapCheck check_simulated_map(const RigExperiment& on);

/// Throws InputError if the simulated camera is set to be displaced beyond the rig's limit from
/// the start on.
void require_simulated_map(const RigExperiment& on);

/// Opens a scenario through a simulated rig if one is named, otherwise as open_session. Throws
/// InputError with one line per issue.
std::unique_ptr<experiment::Session> open_on_rig(const std::filesystem::path& file,
                                                 const RigSessionOptions& options);

}  // namespace microswarm::rig
