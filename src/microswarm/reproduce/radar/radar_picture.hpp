// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/radar/radar_run.hpp"

namespace microswarm::reproduce {

/// The avoidance cost over time, grey while an obstacle is detected, with its mean beside the
/// paper's. `y_max` is the top of the axis.
Plot cost_plot(const RadarRun& run, const std::string& title, double paper_mean, double y_max);

/// What of the world takes part in a run: the way with the circles around it, the goal, and the
/// obstacles where they are at these moments [s] if they are near enough to be detected in time.
Box part_that_matters(const RadarRun& run, const World& world, std::span<const double> moments);

/// Draws a run of the radar at some moments [s], a picture each: the three circles as the navigator
/// had them, the obstacles, those in the detection circle light, velocities as arrows, the
/// deviation α while something is avoided, the way so far with the moments before as P0, P1, …, the
/// way planned with its tree, and where valves are waited for. Titles say when the run ended in a
/// contact. `stem` is the path of the pictures without "-1.png", "-1.svg", "-1.pdf", …; older ones
/// of that name are removed. All of them on one sheet are stem-moments.
void draw_radar_moments(const RadarRun& run, const World& world, std::span<const double> moments,
                        const std::string& title, const std::filesystem::path& stem,
                        std::optional<Box> part = {});

/// Writes the run as stem.h5, and as stem.csv what curves are plotted from: time, place, avoidance
/// cost, gap, radii of the circles, state.
void write_radar_run(const RadarRun& run, const std::filesystem::path& stem);

}  // namespace microswarm::reproduce
