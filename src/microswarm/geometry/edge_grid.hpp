// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Static bucket grid over the directed edges of closed rings (solid on the left). Answers exact
/// distance, containment and nearness; flat arrays, no allocation in a query. Queries are exact
/// everywhere, also outside the box it covers.
class EdgeGrid {
 public:
  EdgeGrid() = default;
  /// `ring_of[i]` names the body that edge i belongs to. The cell size is chosen from the count of
  /// edges when `cell` is 0.
  EdgeGrid(std::span<const Segment> edges, std::span<const std::uint32_t> body_of, double cell = 0);

  std::size_t size() const { return edges_.size(); }
  const Segment& edge(std::size_t i) const { return edges_[i]; }
  std::uint32_t body_of(std::size_t i) const { return bodies_[i]; }
  const Box& box() const { return box_; }

  /// Distance from `p` to the nearest edge, or `limit` when none is nearer.
  double distance(Vec2 p, double limit) const;
  /// Index of the nearest edge within `limit`; size() when there is none.
  std::size_t nearest(Vec2 p, double limit) const;
  /// Is `p` in the solid (or exactly on an edge)? Exact.
  bool in_solid(Vec2 p) const;
  /// Does the capsule of radius r around s keep clear of every edge (distance >= r; for r = 0: not
  /// touching)? Exact.
  bool capsule_free(Segment s, double r) const;
  /// Distance from the segment to the nearest edge, or `limit` when none is nearer.
  double distance(Segment s, double limit) const;
  /// Calls visit(edge index) once for every edge that may meet `box` (each edge once).
  template <class Visit>
  void for_each_in(const Box& box, Visit&& visit) const;

 private:
  Box box_;
  std::vector<Segment> edges_;
  std::vector<std::uint32_t> bodies_;
};

}  // namespace microswarm
