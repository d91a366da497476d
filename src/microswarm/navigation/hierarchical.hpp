// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields.hpp"
#include "microswarm/navigation/navigator.hpp"
#include "microswarm/planning/planners.hpp"

namespace microswarm {

/// Hierarchical D-RRT*: Algorithms 1 and 4 [drrt] with local targets, Eq 4, over the local planner.
struct HierarchicalParams {
  static constexpr std::string_view type_name = "hierarchical_drrt_star";
  double margin = 90;              // r_s
  double swarm_width = 80;
  double base_distance = 320;      // D_base: four times the swarm's width
  double detection_diameter = 300; // D_dec
  double rho_min = 0.2;
  double search_half_angle = 1.5707963267948966;  // α_search
  double search_step = 0.17453292519943295;       // δα
  double obstacle_weight = 1;      // α_1
  double border_weight = 1;        // α_2
  double goal_weight = 4;          // α_3
  double direction_weight = 1;     // α_4
  double influence_range = 8100;   // R of Eq 4c, 4d
  double lookahead = 60;
  DrrtStarParams local;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.margin, {"margin", Unit::um, {0, 1e5}, "Least distance from the centre (r_s)."});
  }
};

}  // namespace microswarm
