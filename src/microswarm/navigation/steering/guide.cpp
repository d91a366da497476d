// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/guide.hpp"

#include <cmath>

namespace microswarm {
namespace {

constexpr double cell = 20;          // of the routes [µm]
constexpr double route_reach = 400;  // along a route [µm]

}  // namespace

void GoalGuide::prepare(const Map& map, Vec2 goal, double clearance, double least) {
  goal_ = goal;
  if (kind_ == Guide::straight) return;
  ways_ = {Way{Route(map, goal_, clearance, cell), clearance},
           Way{Route(map, goal_, least, cell), least}};
}

Vec2 GoalGuide::target(const Map& map, Vec2 from) const {
  if (kind_ == Guide::straight) return goal_;
  for (const Way& way : ways_) {
    if (map.is_free(Segment{from, goal_}, way.clearance)) return goal_;
    if (std::isfinite(way.route.way_from(from)))
      return way.route.ahead(map, from, route_reach, way.clearance);
  }
  return goal_;
}

}  // namespace microswarm
