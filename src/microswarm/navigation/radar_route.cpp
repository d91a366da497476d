// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar_route.hpp"

namespace microswarm {

Vec2 RadarRoute::target(const Map& map, Vec2 p, double clearance, double tolerance) {
  while (next_ + 1 < points_.size() && distance(p, points_[next_]) <= tolerance) ++next_;
  in_sight_ = false;
  for (std::size_t i = points_.size(); i-- > next_ && !in_sight_;) {
    if (!map.is_free(Segment{p, points_[i]}, clearance)) continue;
    next_ = i;
    in_sight_ = true;
  }
  return points_[next_];
}

}  // namespace microswarm
