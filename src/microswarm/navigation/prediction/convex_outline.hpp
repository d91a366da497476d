// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm {

/// The convex hull of a body, as quick to ask as can be. A disc has no edges.
struct ConvexOutline {
  struct Edge {
    Vec2 normal;                ///< outwards, of length 1
    double offset = 0;          ///< of the edge from the centre along it [µm]
    double begin = 0, end = 0;  ///< of the edge along perpendicular(normal) [µm]
  };
  Vec2 centre;        ///< the disc's, or the centroid of the outline [µm]
  double radius = 0;  ///< of the disc, or to the farthest vertex [µm]
  std::vector<Edge> edges;

  /// Distance [µm] of a point at `from_centre`, exact; negative inside.
  double distance_at(Vec2 from_centre) const;
};

/// Makes outlines of bodies and keeps its buffer.
class ConvexOutliner {
 public:
  /// Takes the body into `out`, whose memory is kept.
  void take(const Body& body, ConvexOutline& out);
  /// Share of the hull of the body last taken that is not in the body; 0 for a disc.
  double hollow_share() const { return hollow_share_; }
  /// Would the outline of the body last taken, `out`, tell of it what is not true: that it fills
  /// what is much of its hull, or some of it with one of these places in it?
  bool misleads(const ConvexOutline& out, std::span<const Vec2> places) const;

 private:
  void find_hull(const std::vector<Vec2>& outline);

  std::vector<Vec2> sorted_;
  std::vector<Vec2> hull_;
  double hollow_share_ = 0;
};

}  // namespace microswarm
