// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/planning/rrt.hpp"

namespace microswarm {

/// RRT* (Karaman & Frazzoli): choose parent and rewire within a radius, by length.
struct RrtStarParams : TreeParams {
  static constexpr std::string_view type_name = "rrt_star";
  double search_radius = 120;
  bool shrinking = true;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    TreeParams::fields(self, visit);
    visit(self.search_radius,
          {"search_radius", Unit::um, {1e-3, 1e6}, "Neighbours for choose-parent and rewire."});
    visit(self.shrinking,
          {"shrinking",
           Unit::none,
           {},
           "Shrink the radius as sqrt(log n / n) once that is below search_radius."});
  }
};

/// Uniform RRT*: a node is accepted only at least `spacing` away from every other, so that the tree
/// fills free space evenly. Nodes at the goal are exempt; a spacing beyond the step counts as the
/// step, since else nothing could grow.
struct UniformRrtStarParams : RrtStarParams {
  static constexpr std::string_view type_name = "uniform_rrt_star";
  double spacing = 30;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    RrtStarParams::fields(self, visit);
    visit(self.spacing, {"spacing", Unit::um, {0, 1e6}, "Least distance between nodes."});
  }
};

/// Plans with RRT* or uniform RRT*; see planners.hpp for the form that all planners share.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtStarParams& params, Rng& rng,
          const Stop& stop = {});
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const UniformRrtStarParams& params,
          Rng& rng, const Stop& stop = {});

}  // namespace microswarm
