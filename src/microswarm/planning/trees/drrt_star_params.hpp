// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/planning/trees/rrt_params.hpp"

namespace microswarm::planning {

/// Local planner D-RRT*: Algorithms 2–3, Eq 1–3 and 5–10 [drrt]. Costs are λ_s · turning + λ_l ·
/// length, including the turn out of the start's heading. Beyond the paper: `straighten` shortens
/// the path found under the same cost and the same exact checks; `exact_route` replaces it by the
/// shortest path where that costs less or none was found, unless a body that is no wall is near;
/// `arcs` makes every edge a turn of at least `turn_radius` followed by a straight line, so that a
/// unicycle can follow the path from the start's heading, and takes no route. `as_published`
/// disables the three (docs/explanation/drrt-star.md).
struct DrrtStarParams : RrtStarParams {
  static constexpr std::string_view type_name = "drrt_star";
  double detection_diameter = 300;  // D_dec
  double rho_min = 0.2;
  int candidates = 5;              // M
  int max_attempts = 15;           // N_attempts
  double speed = 40;               // v; step = T_base · v with T_base = 2 s
  double time_step = 0.1;          // dt
  double heading_gain = 4;         // k_p
  double smoothness_weight = 100;  // λ_s
  double length_weight = 1;        // λ_l
  bool straighten = true;
  bool exact_route = true;
  bool arcs = false;
  double turn_radius = 20;
  bool as_published = false;

  DrrtStarParams() { shrinking = false; }  // r_search is constant in the paper
  /// These parameters, with our additions disabled if `as_published`.
  DrrtStarParams in_effect() const;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    RrtStarParams::fields(self, visit);
    visit(self.detection_diameter,
          um("detection_diameter", 1e-3, 1e6, "Diameter of the detection circle."));
    visit(self.rho_min, plain("rho_min", 1e-3, 1, "Floor of the adjust factor."));
    visit(self.candidates, plain("candidates", 1, 1000, "Candidates per extension (M)."));
    visit(self.max_attempts,
          plain("max_attempts", 1, 1000, "Maximum number of samples per extension."));
    visit(self.speed, um_per_s("speed", 1e-3, 1e6, "Forward speed while steering."));
    visit(self.time_step, s("time_step", 1e-4, 10, "Step of the unicycle (dt)."));
    visit(self.heading_gain, per_s("heading_gain", 0, 1e3, "Heading gain of Eq 7 (k_p)."));
    visit(self.smoothness_weight,
          plain("smoothness_weight", 0, 1e6, "Cost of turning, µm per rad (λ_s)."));
    visit(self.length_weight, plain("length_weight", 0, 1e6, "Cost per µm (λ_l)."));
    visit(self.straighten, plain("straighten", "Straighten the path found (beyond the paper)."));
    visit(self.exact_route,
          plain("exact_route", "End on the shortest path if cheaper (beyond the paper)."));
    visit(self.arcs, plain("arcs", "Edges of bounded curvature (beyond the paper)."));
    visit(self.turn_radius, um("turn_radius", 1e-3, 1e6, "Minimum radius of a turn, with arcs."));
    visit(self.as_published, plain("as_published", "The paper's method, without our additions."));
  }
};

/// Reports an issue if `as_published` is combined with given values of what it disables.
Issues validate(const DrrtStarParams& params, const IsGiven& is_given);

}  // namespace microswarm::planning
