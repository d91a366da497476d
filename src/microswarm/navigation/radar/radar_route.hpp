// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Waypoints as phased goals, one after the other [radar]. It never leads back to one that was
/// passed.
class RadarRoute {
 public:
  RadarRoute() = default;
  /// `points` [µm], of which there is at least one, the last being the goal. Those of a plan
  /// `may_skip`: each is only a way to the next.
  RadarRoute(std::vector<Vec2> points, bool may_skip)
      : points_(std::move(points)), may_skip_(may_skip) {}

  bool empty() const { return points_.empty(); }
  std::span<const Vec2> rest() const { return std::span(points_).subspan(next_); }

  /// The phased goal for a swarm at `p`: the next one, or where it may skip the farthest one that
  /// it sees along a straight line with the clearance. One within `tolerance` [µm] is passed; one
  /// within three times that, too, when the next is in sight and nearer than from there.
  Vec2 target(const Map& map, Vec2 p, double clearance, double tolerance);
  /// Was the last target seen?
  bool in_sight() const { return in_sight_; }

 private:
  std::vector<Vec2> points_;
  bool may_skip_ = true;
  std::size_t next_ = 0;
  bool in_sight_ = true;
};

}  // namespace microswarm
