// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm {

/// Solid polygons with exact queries. A few edges are tested one by one behind bounding circles,
/// many by an EdgeGrid. Polygons may overlap.
class PolygonSet {
 public:
  /// Takes the polygons among `bodies` and reuses the memory.
  void assign(std::span<const Body> bodies);

  bool empty() const { return rounds_.empty(); }
  /// Whether `p` is in a polygon or on its boundary. Exact.
  bool holds(Vec2 p) const;
  /// Winding number of all rings around `p`, moved infinitesimally if it is on an edge.
  int winding(Vec2 p) const;
  /// Distance [µm] to the nearest edge, at most `limit`; ignores interiors.
  double edge_distance(Vec2 p, double limit) const;
  double edge_distance(Segment s, double limit) const;
  /// Whether every edge is at least r away and, for r = 0, not touched; ignores interiors.
  bool edges_free(Segment s, double r) const;
  /// Body whose edge is nearest to `p` within `limit`; `none` if there is none.
  std::uint32_t nearest(Vec2 p, double limit) const;
  static constexpr std::uint32_t none = ~0u;
  /// Calls visit(body, edge) for each edge that may meet the box.
  template <class Visit>
  void for_each_edge_in(const Box& box, Visit&& visit) const;
  /// Grid over all edges; empty if they are few.
  const EdgeGrid& grid() const { return grid_; }

 private:
  struct Round {
    Disc circle;
    std::uint32_t first_edge;
    std::uint32_t body;
  };
  std::span<const Segment> edges_at(std::size_t round) const {
    const std::size_t first = rounds_[round].first_edge;
    const std::size_t last =
        round + 1 < rounds_.size() ? rounds_[round + 1].first_edge : edges_.size();
    return {edges_.data() + first, last - first};
  }

  std::vector<Round> rounds_;
  std::vector<Segment> edges_;
  std::vector<std::uint32_t> bodies_;
  EdgeGrid grid_;
};

template <class Visit>
void PolygonSet::for_each_edge_in(const Box& box, Visit&& visit) const {
  if (!grid_.empty()) {
    grid_.for_each_in(box, [&](std::size_t i) { visit(grid_.enclosing_pose(i), grid_.edge(i)); });
    return;
  }
  for (std::size_t k = 0; k < rounds_.size(); ++k) {
    const Disc& c = rounds_[k].circle;
    if (!Box{c.centre, c.centre}.grown(c.radius).overlaps(box)) continue;
    for (const Segment& e : edges_at(k)) visit(rounds_[k].body, e);
  }
}

}  // namespace microswarm
