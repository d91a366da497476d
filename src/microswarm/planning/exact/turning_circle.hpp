// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/world/map/corners.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Tolerance of angles [rad] and unit vectors.
constexpr double angle_slack = 1e-9;

/// Circle that a shortest path turns on, at the clearance around a corner, with the cone of normals
/// at which it can. Angles on it are counted counter-clockwise from where the cone begins [rad].
struct TurningCircle {
  Vec2 centre;
  double radius = 0;  ///< [µm]; 0 for a place
  double from = 0;    ///< direction in which the cone begins [rad]
  double width = 0;   ///< of the cone [rad]; 2π for a disc
  Vec2 first, last;   ///< unit vectors at its ends; unused for a disc
  bool is_disc = false;

  /// Whether a path that touches with this normal bends around the corner.
  bool is_taut(Vec2 normal) const;
  double angle_of(Vec2 normal) const;
  /// Angle from one place to another for one who turns counter-clockwise (`sense` 1) or clockwise
  /// (−1); negative if it is not ahead. On a disc everything is ahead.
  double way_around(double sense, double leaves, double arrives) const;
  /// Where a line in this direction leaves or arrives.
  Vec2 touch(double sense, Vec2 along) const {
    return centre - sense * radius * perpendicular(along);
  }
};

/// A straight line from one circle to the next.
struct TangentLine {
  Vec2 along;         ///< unit vector
  double length = 0;  ///< [µm]
};

/// The tangent of two circles, gone around in these senses; nothing if there is none that is taut
/// at both. Circles that overlap by less than `margin` [µm] touch.
std::optional<TangentLine> tangent(const TurningCircle& a, double sense_a, const TurningCircle& b,
                                   double sense_b, double margin);

/// Free part of a circle: angles from `from` to `to`.
struct Arc {
  double from, to;
};

/// Adds the parts of a circle that are free with `clearance` of walls, border and bodies
/// (null for none). They end where `clearance` + `margin` / 2 is left.
void add_free_arcs(const TurningCircle& circle, const Map& map, const BodySet* moving,
                   double clearance, double margin, std::vector<Arc>& arcs);

/// Number of the arc that holds this angle; −1 if none does.
int arc_at(const TurningCircle& circle, double angle, std::span<const Arc> arcs);

}  // namespace microswarm
