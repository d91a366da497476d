// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/guide.hpp"

#include <cmath>

namespace microswarm {
void GoalGuide::prepare(const Map& map, Vec2 goal, double clearance, double least) {
  goal_ = goal;
  if (kind_ == Guide::straight) return;
  for (const auto& [i, keep] : {std::pair{0U, clearance}, {1U, least}})
    routes_[i] = {DistanceField::to_goal(map, goal_, keep, cell_), keep};
}

Vec2 GoalGuide::target(const Map& map, Vec2 from) const {
  if (kind_ == Guide::straight) return goal_;
  for (const Route& route : routes_) {
    if (map.is_free(Segment{from, goal_}, route.clearance)) return goal_;
    if (std::isfinite(route.field.from(from)))
      return route.field.ahead(map, from, reach_, route.clearance);
  }
  return goal_;
}

}  // namespace microswarm
