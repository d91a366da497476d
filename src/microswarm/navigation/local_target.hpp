// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/core/angles.hpp"
#include "microswarm/core/fields.hpp"
#include "microswarm/planning/planners.hpp"

namespace microswarm {

/// Autonomous local target selection: Algorithm 1, Eq 4 [drrt].
struct LocalTargetParams {
  double base_distance = 320;       // D_base, four times the swarm's width
  double detection_diameter = 320;  // D_dec
  double rho_min = 0.2;
  double half_angle = pi / 2;   // α_search
  double angle_step = pi / 18;  // δα
  double obstacle_weight = 1;   // α_1
  double border_weight = 1;     // α_2
  double goal_weight = 8;       // α_3
  double direction_weight = 2;  // α_4
  std::optional<double> influence_range;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.base_distance,
          {"base_distance", Unit::um, {1e-3, 1e6}, "Farthest target (D_base)."});
    visit(self.detection_diameter,
          {"detection_diameter", Unit::um, {1e-3, 1e6}, "Detection circle (D_dec)."});
    visit(self.rho_min, {"rho_min", Unit::none, {1e-3, 1}, "Floor of the adjust factor."});
    visit(self.half_angle, {"half_angle", Unit::deg, {1, 180}, "Half of the fan (alpha_search)."});
    visit(self.angle_step,
          {"angle_step", Unit::deg, {0.5, 90}, "Between directions (delta alpha)."});
    visit(self.obstacle_weight, {"obstacle_weight", Unit::none, {0, 1e6}, "alpha_1, Eq 4c."});
    visit(self.border_weight, {"border_weight", Unit::none, {0, 1e6}, "alpha_2, Eq 4d."});
    visit(self.goal_weight, {"goal_weight", Unit::none, {0, 1e6}, "alpha_3, Eq 4e."});
    visit(self.direction_weight, {"direction_weight", Unit::none, {0, 1e6}, "alpha_4, Eq 4f."});
    visit(self.influence_range, {"influence_range",
                                 Unit::um,
                                 {1e-3, 1e9},
                                 "R of Eq 4c, 4d; r_s² as a number when left out."});
  }
};

/// A chosen target and the circle that set its distance.
struct LocalTarget {
  Vec2 position;
  Detection detection;
};

/// What Algorithm 1 chooses from.
struct LocalTargetQuery {
  Pose2 swarm;                          ///< s_s
  double goal_heading = 0;              ///< α_g
  double goal_distance = 0;             ///< ‖s_s − s_g‖: no target lies farther
  std::optional<Vec2> previous_target;  ///< s_gpre
  double clearance = 0;                 ///< r_s for CollisionFree [µm]
  double least_distance = 0;            ///< the swarm's radius: where halving ends
};

/// D_ts of the query [µm]: the base distance times ρ of the detection circle (Eq 3 [drrt]).
double target_distance(const Snapshot& world, const LocalTargetQuery& query,
                       const LocalTargetParams& params);

/// Algorithm 1 [drrt]. When no candidate is free, the fan widens to the full circle, then D_ts is
/// halved down to `least_distance`; empty when nothing is free even then. Empty at once when the
/// swarm itself is not free.
std::optional<LocalTarget> select_local_target(const Snapshot& world, const LocalTargetQuery& query,
                                               const LocalTargetParams& params);

}  // namespace microswarm
