// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm::formats {

/// Recorded positions of bodies, by id.
using Tracks = std::map<std::string, Samples>;

/// Reads a CSV of moving bodies: a header with the columns id (or else particle, trackpy's name),
/// t_s, x_um and y_um in any order (further columns are ignored), then one row per body and time.
/// Bodies may be interleaved; the times of each must ascend. Blank lines and lines that start with
/// '#' are skipped. Throws InputError "NAME:LINE: WHY".
Tracks read_tracks(const std::filesystem::path& path);
Tracks parse_tracks(std::string_view text, std::string_view name);

/// Reads pedestrians of the UCY and ETH data sets ("obsmat": blank-separated columns frame, id, x,
/// z, y, vx, vz, vy in m and m/s; 10 frames are 0.4 s). Positions are multiplied by `um_per_m`,
/// times by `time_scale`. Throws InputError "NAME:LINE: WHY".
Tracks read_ucy_obsmat(const std::filesystem::path& path, double um_per_m, double time_scale = 1);

}  // namespace microswarm::formats
