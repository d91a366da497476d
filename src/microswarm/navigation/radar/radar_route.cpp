// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar_route.hpp"

namespace microswarm::navigation {

Vec2 RadarRoute::target(const Map& map, Vec2 p, double clearance, double tolerance) {
  const auto sees = [&](std::size_t i) { return map.is_free(Segment{p, points_[i]}, clearance); };
  const auto is_passed = [&](std::size_t i) {
    const double off = distance(p, points_[i]);
    if (off <= tolerance) return true;
    return off <= 3 * tolerance && sees(i + 1) &&
           distance(p, points_[i + 1]) < distance(points_[i], points_[i + 1]);
  };
  while (next_ + 1 < points_.size() && is_passed(next_)) ++next_;
  in_sight_ = sees(next_);
  for (std::size_t i = points_.size(); may_skip_ && --i > next_;) {
    if (!sees(i)) continue;
    next_ = i;
    in_sight_ = true;
  }
  return points_[next_];
}

}  // namespace microswarm::navigation
