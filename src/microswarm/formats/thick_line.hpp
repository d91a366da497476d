// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/formats/map_parts.hpp"

namespace microswarm::formats {

/// Narrowest line [µm] whose sides differ anywhere on a map.
inline constexpr double min_line_width = 1e-6;

/// Share of its width by which the middle of a line may be moved, to leave out points that say
/// nothing: traced lines have thousands.
inline constexpr double thick_line_rounding = 5e-4;

/// Adds the walls of a line of `width` [µm], at least min_line_width, with round joins and ends: a
/// rectangle for each segment and a disc at each point that thick_line_rounding
/// keeps.
void add_thick_line(MapParts& parts, std::span<const Vec2> points, double width);

}  // namespace microswarm::formats
