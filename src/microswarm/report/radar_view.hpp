// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/navigation/radar/radar_scan.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::report {

/// Outlines the wait zones, dashed.
void draw_wait_zones(Picture& picture, const navigation::RadarParams& params, double width_px);

/// Draws the radar's circles around `p`. The safety circle may coincide with the detection circle,
/// so one is dashed and the other wide.
void draw_radar_circles(Picture& picture, const RadarCircles& circles, Vec2 p);

/// The radar's circles in frame `number`: those of its look, or without one those of its
/// parameters. The record's navigator must be the radar, here and below.
RadarCircles radar_circles(const experiment::Record& record, std::size_t number,
                           const std::optional<navigation::RadarLook>& look = {});

/// Draws what the radar sees in frame `number`: its three circles; the obstacles, lighter inside
/// the detection circle; velocities as arrows; the travelled path and the goal; the planned path
/// with its tree; the wait zones; and the legend. With the `look` of that decision, also the
/// deviation α during avoidance. `world` is the record's.
void draw_radar_view(Picture& picture, const experiment::Record& record, const World& world,
                     std::size_t number, const std::optional<navigation::RadarLook>& look = {});

}  // namespace microswarm::report
