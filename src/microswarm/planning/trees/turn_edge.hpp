// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm::planning {

/// Edge that a unicycle can follow: a turn of constant radius, then a tangent straight line. It is
/// the shortest path of bounded curvature from a pose to a point with free final heading, if that
/// point lies in neither turning circle.
struct TurnEdge {
  double turn = 0;      ///< [rad], left is positive
  double straight = 0;  ///< length of the line [µm]
  double heading = 0;   ///< at the end [rad]
  double length = 0;    ///< total [µm]
};

/// Shorter of the edges that begin with a left and with a right turn; `radius` > 0 [µm].
TurnEdge turn_edge(const Pose2& from, Vec2 to, double radius);

/// Appends the chords of the whole edge to `to`, like append_chords.
void append_edge(const Pose2& from, Vec2 to, double radius, std::vector<Vec2>& out);

/// Appends the chords of the first `most` [µm] of the edge, including both ends, to `out`; the
/// first point is omitted if `out` ends there. The turn's arc is at most chord_error(radius) from
/// its chords.
void append_chords(const Pose2& from, const TurnEdge& edge, double radius, double most,
                   std::vector<Vec2>& out);
double chord_error(double radius);

}  // namespace microswarm::planning
