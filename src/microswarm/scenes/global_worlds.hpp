// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "microswarm/world/map/map.hpp"

namespace microswarm::scenes {

/// Env 1–4 of [global]: the free square 50…350 of a 400 × 400 workspace with a border of 50, with
/// rectangles in it, as in scenarios/papers/global.
inline constexpr int global_worlds = 4;
/// Env `number`, 1 to global_worlds.
Map global_world(int number);

/// Starts and goals of up to four robots.
inline constexpr std::array<Vec2, 4> global_starts{{{60, 300}, {60, 250}, {60, 200}, {60, 150}}};
inline constexpr std::array<Vec2, 4> global_goals{{{330, 300}, {330, 200}, {330, 250}, {330, 150}}};
/// Other goals for the same tree (Fig 10).
inline constexpr std::array<Vec2, 4> global_other_goals{
    {{330, 100}, {280, 200}, {100, 250}, {300, 75}}};

}  // namespace microswarm::scenes
