// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// An edge that a unicycle can drive: a turn of constant radius, then a straight line that touches
/// it. The shortest way of bounded curvature from a pose to a point with a free heading there,
/// where that point lies in neither turning circle.
struct TurnEdge {
  double turn = 0;      ///< [rad], left is positive
  double straight = 0;  ///< length of the line [µm]
  double heading = 0;   ///< at the end [rad]
  double length = 0;    ///< of both [µm]
};

/// The shorter of the edges that begin with a left and with a right turn; `radius` > 0 [µm].
TurnEdge turn_edge(const Pose2& from, Vec2 to, double radius);

/// Chords of the whole edge to `to`, appended like those below.
void append_edge(const Pose2& from, Vec2 to, double radius, std::vector<Vec2>& out);

/// Chords of the edge as far as `most` [µm], its ends included, appended to `out` but for the first
/// point when `out` ends there. The turn's arc is at most chord_error(radius) from its chords.
void append_chords(const Pose2& from, const TurnEdge& edge, double radius, double most,
                   std::vector<Vec2>& out);
double chord_error(double radius);

}  // namespace microswarm
