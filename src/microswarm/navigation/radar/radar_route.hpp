// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/map/map.hpp"

namespace microswarm::navigation {

/// Waypoints as successive phased goals [radar]. Never returns to a waypoint already passed.
class RadarRoute {
 public:
  RadarRoute() = default;
  /// `points` [µm], at least one; the last is the goal. With `may_skip`, as for planned waypoints,
  /// waypoints may be left out.
  RadarRoute(std::vector<Vec2> points, bool may_skip)
      : points_(std::move(points)), may_skip_(may_skip) {}

  bool empty() const { return points_.empty(); }
  std::span<const Vec2> rest() const { return std::span(points_).subspan(next_); }

  /// Phased goal for a swarm at `p`: the next one or, if it may skip, the farthest one visible
  /// along a straight line with the clearance. A waypoint within `tolerance` [µm] is passed. So is
  /// one within three times that, if the next is visible and nearer to `p` than to the waypoint.
  Vec2 target(const Map& map, Vec2 p, double clearance, double tolerance);
  /// Whether the last target was visible.
  bool in_sight() const { return in_sight_; }

 private:
  std::vector<Vec2> points_;
  bool may_skip_ = true;
  std::size_t next_ = 0;
  bool in_sight_ = true;
};

}  // namespace microswarm::navigation
