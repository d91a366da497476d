// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/world/obstacles/disc_set.hpp"
#include "microswarm/world/obstacles/polygon_set.hpp"

namespace microswarm {

/// What a detection circle sees, for Eq 1–2 [drrt].
struct Survey {
  double covered_area = 0;  ///< circle ∩ obstacles [µm²], overlaps counted once
  int obstacles = 0;        ///< N: obstacles that meet the circle
  double distance_sum = 0;  ///< Σ d_min,i [µm]; 0 for one that holds the centre
};

/// A set of solid discs and polygons with exact queries. "Free with clearance r" means: no point of
/// the set is nearer than r, and for r = 0 not touching. Bodies may touch and overlap. Queries
/// neither allocate (a survey of more than a hundred obstacles does) nor change the set.
class BodySet {
 public:
  BodySet() = default;
  /// `apart` promises that no two polygons overlap, as those of a map: surveys are quicker then.
  explicit BodySet(std::vector<Body> bodies, bool apart = false);
  /// Takes new bodies and keeps the buffers: moving obstacles do this at every tick.
  void assign(std::span<const Body> bodies);

  std::span<const Body> bodies() const { return bodies_; }
  bool empty() const { return bodies_.empty(); }

  /// Distance [µm] from `p` to the nearest body, 0 inside one, at most `limit`.
  double clearance(Vec2 p, double limit) const;
  /// Distance [µm] from the segment to the nearest body, 0 when they meet, at most `limit`.
  double clearance(Segment s, double limit) const;
  /// Is `p` in a body or on its boundary?
  bool holds(Vec2 p) const;
  bool is_free(Vec2 p, double r) const;
  /// The whole capsule of radius r around s: exact, so that no thin wall is stepped over.
  bool is_free(Segment s, double r) const;
  /// Is the capsule free, when it is known that s.a is in no body? Saves asking for it.
  bool is_free_from_outside(Segment s, double r) const;
  /// Body that holds or is nearest to `p` within `limit`; bodies().size() when there is none.
  std::size_t nearest(Vec2 p, double limit) const;

  /// Adds what the circle sees of this set to `survey` (bodies of one obstacle count once).
  void survey(Disc circle, Survey& survey) const;

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

/// Depth [µm] of `p` in the body, negative outside: distance to its boundary.
double depth_in(const Body& body, Vec2 p);

/// What the circle sees of two sets together: obstacles of both, the area that both cover once.
Survey survey(Disc circle, const BodySet& walls, const BodySet& moving);

}  // namespace microswarm
