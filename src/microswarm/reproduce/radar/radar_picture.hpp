// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/radar/radar_run.hpp"

namespace microswarm::reproduce {

/// Avoidance cost over time, grey while an obstacle is detected, with its mean and the paper's.
/// `y_max` is the top of the axis.
report::Plot cost_plot(const RadarRun& run, const std::string& title, double paper_mean,
                       double y_max);

/// The part of the world relevant to a run: the path with the circles around it, the goal, and the
/// obstacles that are near enough to be detected, at their positions at these moments [s].
Box part_that_matters(const RadarRun& run, const World& world, std::span<const double> moments);

/// Draws a run of the radar at several moments [s], one picture each: draw_radar_view, with the
/// earlier moments as P0, P1, … on the travelled path. Titles mention a final contact. `stem` is
/// the path of the pictures without "-1.png", "-1.svg", "-1.pdf", …; older files with these names
/// are removed. stem-moments shows all moments on one sheet.
void draw_radar_moments(const RadarRun& run, const World& world, std::span<const double> moments,
                        const std::string& title, const std::filesystem::path& stem,
                        std::optional<Box> part = {});

/// Writes the run as stem.h5, and the data of the curves as stem.csv: time, position, avoidance
/// cost, gap, radii of the circles, state.
void write_radar_run(const RadarRun& run, const std::filesystem::path& stem);

}  // namespace microswarm::reproduce
