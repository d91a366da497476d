// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "microswarm/report/plot.hpp"
#include "radar_run.hpp"

namespace microswarm::cli {

/// The avoidance cost over time, grey while an obstacle is detected, with its mean beside the
/// paper's. `y_max` is the top of the axis.
Plot cost_plot(const RadarRun& run, const std::string& title, double paper_mean, double y_max);

/// What of the world takes part in a run: the way with the circles around it, the goal, and the
/// obstacles where they are at these moments [s] if they are near enough to be detected in time.
Box part_that_matters(const RadarRun& run, const World& world, std::span<const double> moments);

/// Draws a run of the radar at some moments [s], a picture each: the three circles as the navigator
/// had them, the obstacles, those in the detection circle light, the way so far, the way planned
/// and where valves are waited for. Titles say when the run ended in a contact. `stem` is the path
/// of the pictures without "-1.png", …; older ones of that name are removed.
void draw_radar_moments(const RadarRun& run, const World& world, std::span<const double> moments,
                        const std::string& title, const std::filesystem::path& stem,
                        std::optional<Box> part = {});

}  // namespace microswarm::cli
