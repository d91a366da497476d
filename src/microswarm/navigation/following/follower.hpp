// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "microswarm/contracts/command.hpp"

namespace microswarm::navigation {

/// Position on a path: index of a segment and the fraction of it already passed.
struct PathPosition {
  std::size_t piece = 0;
  double share = 0;
};

/// Nearest position to `p` on the path, at or after `from`. The path has at least one point.
PathPosition nearest_position(std::span<const Vec2> path, Vec2 p, PathPosition from);
/// Point `ahead` µm further along the path; its end if the path is shorter.
Vec2 point_ahead(std::span<const Vec2> path, PathPosition position, double ahead);
/// Remaining length of the path [µm].
double remaining(std::span<const Vec2> path, PathPosition position);

/// Pure pursuit: heads for the point `lookahead` µm along the path from the nearest position, to
/// which `position` is advanced. Commands `speed`, reduced while the heading is off by more than a
/// right angle.
Command pursue(std::span<const Vec2> path, PathPosition& position, const Pose2& pose,
               double lookahead, double speed);

}  // namespace microswarm::navigation
