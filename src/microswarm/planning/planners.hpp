// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <variant>

#include "microswarm/core/fields.hpp"
#include "microswarm/planning/plan.hpp"

namespace microswarm {

/// A* on a grid of 8 neighbours whose origin is the start; no corner is cut and every edge is checked
/// with the clearance. Optimal on its grid.
struct AStarParams {
  static constexpr std::string_view type_name = "a_star";
  double clearance = 40;
  double goal_tolerance = 50;
  double cell = 20;
  int max_nodes = 4'000'000;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, {"clearance", Unit::um, {0, 1e6}, "Least distance to walls."});
    visit(self.goal_tolerance, {"goal_tolerance", Unit::um, {0, 1e6}, "How near counts."});
    visit(self.cell, {"cell", Unit::um, {1e-3, 1e6}, "Grid spacing."});
    visit(self.max_nodes, {"max_nodes", Unit::none, {1, 1e8}, "Cells to open at most."});
  }
};

/// What every sampling planner here has.
struct TreeParams {
  double clearance = 40;
  double goal_tolerance = 50;
  double step = 80;
  double goal_bias = 0.1;
  int max_nodes = 5000;
  int max_iterations = 100'000;
  bool stop_at_first = true;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, {"clearance", Unit::um, {0, 1e6}, "Least distance to obstacles."});
    visit(self.goal_tolerance, {"goal_tolerance", Unit::um, {1e-3, 1e6}, "How near counts."});
    visit(self.step, {"step", Unit::um, {1e-3, 1e6}, "Base length of one extension."});
    visit(self.goal_bias, {"goal_bias", Unit::none, {0, 1}, "Share of samples at the goal."});
    visit(self.max_nodes, {"max_nodes", Unit::none, {1, 1e7}, "Nodes to grow at most."});
    visit(self.max_iterations, {"max_iterations", Unit::none, {1, 1e8}, "Tries at most."});
    visit(self.stop_at_first,
          {"stop_at_first", Unit::none, {}, "Stop at the first path, or grow to the limits."});
  }
};

/// RRT (LaValle): nearest node, fixed step.
struct RrtParams : TreeParams {
  static constexpr std::string_view type_name = "rrt";
};

/// RRT* (Karaman & Frazzoli): choose parent and rewire within a radius.
struct RrtStarParams : TreeParams {
  static constexpr std::string_view type_name = "rrt_star";
  double search_radius = 160;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    TreeParams::fields(self, visit);
    visit(self.search_radius,
          {"search_radius", Unit::um, {1e-3, 1e6}, "Neighbours for choose-parent and rewire."});
  }
};

/// Uniform RRT*: a node is accepted only at least `spacing` away from every other, so that the tree
/// fills free space evenly.
struct UniformRrtStarParams : RrtStarParams {
  static constexpr std::string_view type_name = "uniform_rrt_star";
  double spacing = 30;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    RrtStarParams::fields(self, visit);
    visit(self.spacing, {"spacing", Unit::um, {0, 1e6}, "Least distance between nodes."});
  }
};

/// The local planner of D-RRT*: Algorithms 2–3, Eq 1–3 and 5–10 [drrt].
struct DrrtStarParams : RrtStarParams {
  static constexpr std::string_view type_name = "drrt_star";
  double detection_diameter = 300;   // D_dec
  double rho_min = 0.2;
  int candidates = 5;                // M
  int max_attempts = 15;             // N_attempts
  double speed = 40;                 // v; step = T_base · v with T_base = 2 s
  double time_step = 0.1;            // dt
  double heading_gain = 2;           // k_p
  double smoothness_weight = 100;    // λ_s
  double length_weight = 1;          // λ_l
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    RrtStarParams::fields(self, visit);
    visit(self.detection_diameter,
          {"detection_diameter", Unit::um, {1e-3, 1e6}, "Diameter of the detection circle."});
    visit(self.rho_min, {"rho_min", Unit::none, {1e-3, 1}, "Floor of the adjust factor."});
    visit(self.candidates, {"candidates", Unit::none, {1, 1000}, "Candidates per extension (M)."});
    visit(self.max_attempts, {"max_attempts", Unit::none, {1, 1000}, "Samples per extension."});
    visit(self.speed, {"speed", Unit::um_per_s, {1e-3, 1e6}, "Forward speed while steering."});
    visit(self.time_step, {"time_step", Unit::s, {1e-4, 10}, "Step of the unicycle (dt)."});
    visit(self.heading_gain, {"heading_gain", Unit::per_s, {0, 1e3}, "Gain of Eq 7 (k_p)."});
    visit(self.smoothness_weight,
          {"smoothness_weight", Unit::none, {0, 1e6}, "Cost of turning, µm per rad (λ_s)."});
    visit(self.length_weight, {"length_weight", Unit::none, {0, 1e6}, "Cost per µm (λ_l)."});
  }
};

/// One calling form for all planners. Pure: the same arguments and random stream give the same bits.
/// A bad start or goal is a status, never an exception; `stop` is asked at least once a millisecond.
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const AStarParams& params, Rng& rng,
          const Stop& stop = {});
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtParams& params, Rng& rng,
          const Stop& stop = {});
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtStarParams& params, Rng& rng,
          const Stop& stop = {});
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const UniformRrtStarParams& params,
          Rng& rng, const Stop& stop = {});
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const DrrtStarParams& params, Rng& rng,
          const Stop& stop = {});

/// Any planner, chosen at run time by its `type`.
using PlannerParams =
    std::variant<DrrtStarParams, RrtStarParams, UniformRrtStarParams, RrtParams, AStarParams>;
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const PlannerParams& params, Rng& rng,
          const Stop& stop = {});

/// Eq 1–3 [drrt] for one detection circle, the factor floored at `rho_min`.
Detection detect(const Snapshot& world, Disc circle, double rho_min);

}  // namespace microswarm
