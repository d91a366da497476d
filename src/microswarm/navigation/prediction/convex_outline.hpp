// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/geometry/shapes.hpp"
#include "microswarm/navigation/prediction/convex_outline_tuning.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm::navigation {

/// Convex hull of a body, optimised for distance queries. A disc has no edges.
struct ConvexOutline {
  struct Edge {
    Vec2 normal{};              ///< outward unit normal
    double offset = 0;          ///< of the edge from the centre along the normal [µm]
    double begin = 0, end = 0;  ///< of the edge along perpendicular(normal) [µm]
  };
  Vec2 centre{};      ///< the disc's, or the centroid of the outline [µm]
  double radius = 0;  ///< of the disc, or to the farthest vertex [µm]
  std::vector<Edge> edges{};

  /// Exact distance [µm] of the point `from_centre` relative to the centre; negative inside.
  double distance_at(Vec2 from_centre) const;
  /// Minimum distance [µm] of a point that moves straight from `a` to `b`, both relative to the
  /// centre; beyond `near` it may be the enclosing disc's. The distance is convex along the way.
  double distance_along(Vec2 a, Vec2 b, double near) const;
  /// The same for many points (`x`, `y`), bit-identical.
  void distances_at(std::span<const double> x, std::span<const double> y,
                    std::span<double> distances) const;
};

/// Computes outlines of bodies; reuses its buffer.
class ConvexOutliner {
 public:
  explicit ConvexOutliner(const ConvexOutlineTuning& tuning = {}) : tuning_(tuning) {}

  /// Computes the outline of the body into `out`, whose memory is reused.
  void take(const Body& body, ConvexOutline& out);
  /// Fraction of the hull of the last body that is not in the body; 0 for a disc.
  double hollow_share() const { return hollow_share_; }
  /// Whether the outline `out` of the last body is misleading: much of it is not in the body, or
  /// some of it is not and it contains one of these positions.
  bool misleads(const ConvexOutline& out, std::span<const Vec2> positions) const;

 private:
  void take(const Polygon& polygon, ConvexOutline& out);
  void find_hull(const std::vector<Vec2>& outline);

  ConvexOutlineTuning tuning_;
  std::vector<Vec2> sorted_;
  std::vector<Vec2> hull_;
  double hollow_share_ = 0;
};

}  // namespace microswarm::navigation
