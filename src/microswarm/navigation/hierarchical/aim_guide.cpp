// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/aim_guide.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::navigation {

void AimGuide::prepare(const std::shared_ptr<const Map>& map, const Aim& aim,
                       const HierarchicalParams& params) {
  aim_ = aim.position;
  reach_ = 1.5 * params.target.base_distance;
  latest_.reset();
  routes_.clear();
  if (params.guide == Guide::straight) return;
  field_ = planning::DistanceField::to_goal(map, aim.position, params.clearance, params.route_cell);
  for (const double share : {1.0, 0.5, 0.25, 0.125, 0.0}) {
    const double clearance =
        std::min(params.clearance + share * params.extra_clearance, (1 - 1e-9) * aim.clearance);
    routes_.push_back({clearance, planning::Route(map, aim.position, clearance)});
  }
}

void AimGuide::stop_with(const Stop& stop) {
  field_.stop_with(stop);
  for (WallRoute& one : routes_) one.route.stop_with(stop);
}

Vec2 AimGuide::towards(Vec2 from) {
  if (!has_routes()) return aim_;
  if (!latest_ || !(latest_->from == from)) {
    const Vec2 ahead = field_.ahead(from, reach_);
    latest_ = {from, ahead == from ? aim_ : ahead};
  }
  return latest_->towards;
}

double AimGuide::length_from(Vec2 p, double detour) {
  const double straight = distance(p, aim_);
  if (!has_routes()) return straight;
  const double length = field_.from(p);
  return std::isfinite(length) ? length : straight + detour;
}

}  // namespace microswarm::navigation
