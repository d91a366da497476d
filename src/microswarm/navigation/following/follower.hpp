// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "microswarm/contracts/command.hpp"

namespace microswarm {

/// Place on a path: piece number and the share of it that is done.
struct PathPlace {
  std::size_t piece = 0;
  double share = 0;
};

/// Nearest place to `p` on the path, at or after `from`; the path has at least one point.
PathPlace nearest_place(std::span<const Vec2> path, Vec2 p, PathPlace from);
/// Point `ahead` µm further along the path; its end when the path is shorter.
Vec2 point_ahead(std::span<const Vec2> path, PathPlace place, double ahead);
/// What is left of the path [µm].
double remaining(std::span<const Vec2> path, PathPlace place);

/// Pure pursuit: heads for the point `lookahead` µm along the path from the nearest place (which is
/// moved on) at `speed`, slower while the heading is off by more than a right angle.
Command pursue(std::span<const Vec2> path, PathPlace& place, const Pose2& pose, double lookahead,
               double speed);

}  // namespace microswarm
