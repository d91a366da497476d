// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::planning {

/// Fields that planners by trees have in common.
namespace tree_fields {
inline constexpr FieldInfo clearance = um("clearance", 0, 1e6, "Minimum distance to obstacles.");
inline constexpr FieldInfo goal_tolerance =
    um("goal_tolerance", 1e-3, 1e6, "Distance at which the goal counts as reached.");
inline constexpr FieldInfo step = um("step", 1e-3, 1e6, "Base length of one extension.");
inline constexpr FieldInfo max_nodes = plain("max_nodes", 1, 1e7, "Maximum number of nodes.");
inline constexpr FieldInfo max_iterations =
    plain("max_iterations", 1, 1e8, "Maximum number of iterations.");
inline constexpr FieldInfo sample_pitch =
    um("sample_pitch", 0, 1e6, "Pitch of the lattice of most samples; 0: none.");
inline constexpr FieldInfo sample_origin =
    um("sample_origin", -1e6, 1e6, "A point of that lattice.");
}  // namespace tree_fields

/// Parameters common to all sampling planners. All stop alike: the first node within
/// `goal_tolerance` of the goal ends the path, and nothing is appended unchecked. With a pitch,
/// nine of ten samples across the map are points of a lattice (S. LaValle, M. Branicky and S.
/// Lindemann, IJRR 2004); the others are uniform, so that any passage is found in the end.
struct TreeParams {
  double clearance = 40;
  double goal_tolerance = 50;
  double step = 80;
  double goal_bias = 0.1;
  int max_nodes = 5000;
  int max_iterations = 100'000;
  bool stop_at_first = true;
  double sample_pitch = 0;
  Vec2 sample_origin{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, tree_fields::clearance);
    visit(self.goal_tolerance, tree_fields::goal_tolerance);
    visit(self.step, tree_fields::step);
    visit(self.goal_bias, plain("goal_bias", 0, 1, "Share of samples at the goal."));
    visit(self.max_nodes, tree_fields::max_nodes);
    visit(self.max_iterations, tree_fields::max_iterations);
    visit(self.stop_at_first,
          plain("stop_at_first", "Stop at the first path; else grow to the limits."));
    visit(self.sample_pitch, tree_fields::sample_pitch);
    visit(self.sample_origin, tree_fields::sample_origin);
  }
};

/// RRT (LaValle): nearest node, fixed step.
struct RrtParams : TreeParams {
  static constexpr std::string_view type_name = "rrt";
};

/// RRT-Connect (Kuffner & LaValle): trees from the start and from the goal that grow towards each
/// other. The first path they meet on, which is not a short one. Samples as in TreeParams.
struct RrtConnectParams {
  static constexpr std::string_view type_name = "rrt_connect";
  double clearance = 40;
  double goal_tolerance = 50;
  double step = 80;
  int max_nodes = 5000;
  int max_iterations = 100'000;
  double sample_pitch = 0;
  Vec2 sample_origin{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, tree_fields::clearance);
    visit(self.goal_tolerance, tree_fields::goal_tolerance);
    visit(self.step, tree_fields::step);
    visit(self.max_nodes, tree_fields::max_nodes);
    visit(self.max_iterations, tree_fields::max_iterations);
    visit(self.sample_pitch, tree_fields::sample_pitch);
    visit(self.sample_origin, tree_fields::sample_origin);
  }
};

/// RRT* (Karaman & Frazzoli): chooses parents and rewires within a radius, by length.
struct RrtStarParams : TreeParams {
  static constexpr std::string_view type_name = "rrt_star";
  double search_radius = 120;
  bool shrinking = true;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    TreeParams::fields(self, visit);
    visit(self.search_radius,
          um("search_radius", 1e-3, 1e6, "Neighbour radius of choose-parent and rewire."));
    visit(self.shrinking, plain("shrinking", "Shrink the radius as sqrt(log n / n)."));
  }
};

/// Uniform RRT*: accepts a node only if it is at least `spacing` from every other, so that the tree
/// fills the free space evenly. Nodes at the goal are exempt. A spacing beyond the step counts as
/// the step; otherwise nothing could grow.
struct UniformRrtStarParams : RrtStarParams {
  static constexpr std::string_view type_name = "uniform_rrt_star";
  double spacing = 30;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    RrtStarParams::fields(self, visit);
    visit(self.spacing, um("spacing", 0, 1e6, "Minimum distance between nodes."));
  }
};

}  // namespace microswarm::planning
