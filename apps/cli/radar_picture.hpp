// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "microswarm/experiment/record.hpp"

namespace microswarm::cli {

/// The frame of a record at time t [s], or the last one before.
const Frame& frame_at(const Record& record, double t);

/// Draws a run of the radar at some moments [s], a picture each: the three circles, the obstacles,
/// those in the detection circle light, the way so far. `stem` is the path of the pictures without
/// "-1.png", …
void draw_radar_moments(const Record& record, const World& world, std::span<const double> moments,
                        const std::string& title, const std::filesystem::path& stem);

}  // namespace microswarm::cli
