// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::rig {

/// Estimate of what a run writes into its folder in `seconds`, without a video [B]: commands.csv,
/// and the record three times, since a new one is written before the last one is replaced.
double needed_space(const Rig& rig, double tick, double seconds);

/// Space for this user where `path` is or will be [B]; nothing if the system does not say.
std::optional<double> free_space(std::filesystem::path path);

/// Throws InputError if less than half of what a run needs is free in its folder [B].
void require_space(const std::filesystem::path& folder, double needed, double free);

}  // namespace microswarm::rig
