// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::rig {

/// Estimate of the space that a run of `seconds` needs in its folder, without a video [B]:
/// commands.csv, and the record three times, since a new one is written before the last one is
/// replaced. After `written` seconds what is on the disk by then is not needed again.
double needed_space(const Rig& rig, double tick, double seconds, double written = 0);

/// Space for this user where `path` is or will be [B]; nothing if the system does not say.
std::optional<double> free_space(std::filesystem::path path);

/// Throws InputError if less than half of what a run needs is free in its folder [B].
void require_space(const std::filesystem::path& folder, double needed, double free);

}  // namespace microswarm::rig
