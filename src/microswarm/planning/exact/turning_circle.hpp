// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/world/map/corners.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::planning {

/// Tolerance of angles [rad] and unit vectors.
constexpr double angle_slack = 1e-9;

/// Circle of radius `clearance` around a corner, on which a shortest path can turn, with the cone
/// of admissible normals. Angles are measured counter-clockwise from the start of the cone [rad].
struct TurningCircle {
  Vec2 centre{};
  double radius = 0;     ///< [µm]; 0 for a point
  double from = 0;       ///< direction in which the cone begins [rad]
  double width = 0;      ///< of the cone [rad]; 2π for a disc
  Vec2 first{}, last{};  ///< unit vectors at its ends; unused for a disc
  bool is_disc = false;

  /// Whether a path that touches with this normal is taut, so bends around the corner; the normal
  /// may miss the cone by `slack` [rad].
  bool is_taut(Vec2 normal, double slack = angle_slack) const;
  /// Angle of a normal [rad]; that of a taut one may be outside the cone by its slack.
  double angle_at(Vec2 normal) const;
  /// Angle from one angle to another [rad], counter-clockwise (`sense` 1) or clockwise (−1);
  /// negative if the second is not ahead. On a disc every angle is ahead.
  double angle_around(double sense, double leaves, double arrives) const;
  /// Point where a line in this direction leaves or arrives.
  Vec2 touch(double sense, Vec2 along) const {
    return centre - sense * radius * perpendicular(along);
  }
};

/// A straight line from one circle to the next.
struct TangentLine {
  Vec2 along{};       ///< unit vector
  double length = 0;  ///< [µm]

  Segment from(Vec2 p) const { return {p, p + length * along}; }
};

/// Tangent of two circles turned in these senses; nothing unless it is taut at both. Circles that
/// overlap by less than `margin` [µm] count as touching, and a point beside a face of a circle's
/// corner may be that much nearer to it than the circle reaches.
std::optional<TangentLine> tangent(const TurningCircle& a, double sense_a, const TurningCircle& b,
                                   double sense_b, double margin);

/// Free part of a circle: the angles from `from` to `to` [rad].
struct Arc {
  double from, to;
};

/// Adds the arcs of a circle that keep `clearance` [µm] from walls, border and bodies (null for
/// none). They end where the distance is `clearance` + `margin` / 2.
void add_free_arcs(const TurningCircle& circle, const Map& map, const BodySet* moving,
                   double clearance, double margin, std::vector<Arc>& arcs);

/// Index of the arc that contains this angle, or the end of the cone beside it; −1 if none does.
int arc_at(const TurningCircle& circle, double angle, std::span<const Arc> arcs);

}  // namespace microswarm::planning
