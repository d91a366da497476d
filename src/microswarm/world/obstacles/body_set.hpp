// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/world/obstacles/disc_set.hpp"
#include "microswarm/world/obstacles/polygon_set.hpp"

namespace microswarm {

/// Contents of a detection circle, for Eq 1–2 [drrt].
struct Survey {
  double covered_area = 0;  ///< circle ∩ obstacles [µm²], overlaps counted once
  int obstacles = 0;        ///< N: obstacles that intersect the circle
  double distance_sum = 0;  ///< Σ d_min,i [µm]; 0 for an obstacle that contains the centre
};

/// Set of solid discs and polygons with exact queries. "Free with clearance r" means that no point
/// of the set is nearer than r or, for r = 0, that nothing touches. Bodies may touch and overlap.
/// Queries do not change the set and do not allocate, except a survey of more than a hundred
/// obstacles.
class BodySet {
 public:
  BodySet() = default;
  /// `apart` promises that no two polygons overlap, as in a map; this makes surveys faster.
  explicit BodySet(std::vector<Body> bodies, bool apart = false);
  /// Replaces the bodies and reuses the buffers; called at every tick for moving obstacles.
  void assign(std::span<const Body> bodies);

  std::span<const Body> bodies() const { return bodies_; }
  bool empty() const { return bodies_.empty(); }

  /// Distance [µm] from `p` to the nearest body, 0 inside one, at most `limit`.
  double clearance(Vec2 p, double limit) const;
  /// Distance [µm] from the segment to the nearest body, 0 if they meet, at most `limit`.
  double clearance(Segment s, double limit) const;
  /// Whether `p` is in a body or on its boundary.
  bool holds(Vec2 p) const;
  bool is_free(Vec2 p, double r) const;
  /// Tests the whole capsule of radius r around s exactly, so no thin wall is missed.
  bool is_free(Segment s, double r) const;
  /// Whether the capsule is free, given that s.a is in no body; saves that test.
  bool is_free_from_outside(Segment s, double r) const;
  /// Body that contains or is nearest to `p` within `limit`; bodies().size() if none.
  std::size_t nearest(Vec2 p, double limit) const;

  /// Adds the part of this set in the circle to `survey` (bodies of one obstacle count once). If
  /// stopped, the area is of no meaning.
  void survey(Disc circle, Survey& survey, const Stop& stop = {}) const;

  const DiscSet& discs() const { return discs_; }
  const PolygonSet& polygons() const { return polygons_; }
  bool polygons_apart() const { return apart_; }

 private:
  void index();

  std::vector<Body> bodies_;
  DiscSet discs_;
  PolygonSet polygons_;
  bool apart_ = false;
};

/// Whether the body is a polygon and `p` in it or on its border.
bool is_in_polygon(Vec2 p, const Body& body);

/// Depth [µm] of `p` in the body, negative outside: distance to its boundary.
double depth_in(const Body& body, Vec2 p);

/// Survey of two sets together: obstacles of both; area covered by both counts once.
Survey survey(Disc circle, const BodySet& walls, const BodySet& moving, const Stop& stop = {});

}  // namespace microswarm
