// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/guide.hpp"

#include <utility>

namespace microswarm::navigation {

void GoalGuide::prepare(const std::shared_ptr<const Map>& map, Vec2 goal, double clearance,
                        double least) {
  goal_ = goal;
  if (kind_ == Guide::straight) return;
  for (const auto& [i, keep] : {std::pair{0U, clearance}, {1U, least}})
    candidates_[i] = {planning::Route(map, goal_, keep), keep};
}

Vec2 GoalGuide::target(const Map& map, Vec2 from) {
  if (kind_ == Guide::straight) return goal_;
  for (Candidate& candidate : candidates_) {
    if (map.is_free(Segment{from, goal_}, candidate.clearance)) return goal_;
    const Vec2 ahead = candidate.route.ahead(from, reach_);
    if (!(ahead == from)) return ahead;
  }
  return goal_;
}

}  // namespace microswarm::navigation
