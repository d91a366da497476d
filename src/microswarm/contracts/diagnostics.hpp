// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Radii of the three circles around the swarm's centre [µm]: Fig 2 [radar].
struct RadarCircles {
  double prediction = 0;  ///< r_p
  double safety = 0;      ///< r_f
  double detection = 0;   ///< r_d
  bool operator==(const RadarCircles&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.prediction, um("prediction", "Radius r_p."));
    visit(self.safety, um("safety", "Radius r_f, as controlled by Eq 24."));
    visit(self.detection, um("detection", "Radius r_d."));
  }
};

/// q_t and q_a of Eq 10–12 [radar].
struct RadarWeights {
  double target = 1;
  double avoidance = 0.5;
  bool operator==(const RadarWeights&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.target, plain("target", "q_t."));
    visit(self.avoidance, plain("avoidance", "q_a."));
  }
};

/// Why a direction is not in χ_2 of Eq 17 [radar], or why it is not chosen from it: it turns too
/// far while others do not.
enum class BeamFate { kept, obstacle, wall, turn };
constexpr auto enum_names(BeamFate) {
  return std::array<std::pair<BeamFate, std::string_view>, 4>{{{BeamFate::kept, "kept"},
                                                               {BeamFate::obstacle, "obstacle"},
                                                               {BeamFate::wall, "wall"},
                                                               {BeamFate::turn, "turn"}}};
}

/// One of the alternative directions, Eq 8 [radar].
struct RadarBeam {
  double heading = 0;  ///< θ_i [rad]
  BeamFate fate = BeamFate::kept;
  std::optional<std::uint32_t> obstacle{};  ///< number of the obstacle that screens it
  double score = 0;                         ///< φ_i of Eq 9, 31, over χ_2; 0 if screened
  bool operator==(const RadarBeam&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.heading, rad("heading", "Heading, θ_i of Eq 8 [radar]."));
    visit(self.fate, plain("fate", "Kept, or the reason why it is not."));
    visit(self.obstacle, plain("obstacle", "Number of the obstacle that screens it."));
    visit(self.score, plain("score", "Score φ_i of Eq 9; 0 if screened."));
  }
};

/// Decision of the hierarchical radar in full: every direction and why it was kept or screened.
struct RadarDiagnostics {
  static constexpr std::string_view type_name = "radar";
  Vec2 centre{};              ///< of the swarm, O_s [µm]
  double radius = 0;          ///< of the swarm, r_s [µm]
  Vec2 target{};              ///< O_t [µm]
  RadarCircles circles{};     ///< with the controlled r_f of Eq 24
  double step = 0;            ///< d_p [µm]
  double obstacle_reach = 0;  ///< kept from obstacles by a predictive swarm [µm]
  double wall_reach = 0;      ///< the same for walls and border [µm]
  RadarWeights weights{};
  std::optional<std::uint32_t> nearest{};  ///< body in the detection circle to which Eq 9 refers
  std::optional<std::uint32_t> best{};     ///< index into beams; nothing if all are screened
  std::optional<double> straight{};        ///< θ_f of Eq 14 if it is taken: nothing detected [rad]
  std::vector<RadarBeam> beams{};          ///< directions 0, β, 2β, …
  bool operator==(const RadarDiagnostics&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, um("centre", "Centre of the swarm when the command acts, O_s."));
    visit(self.radius, um("radius", "Radius of the swarm, r_s."));
    visit(self.target, um("target", "Target, O_t."));
    visit(self.circles, plain("circle", "Circles around the swarm."));
    visit(self.step, um("step", "Distance of the predictive swarms, d_p."));
    visit(self.obstacle_reach, um("obstacle_reach", "Distance of their centres from obstacles."));
    visit(self.wall_reach, um("wall_reach", "Distance of their centres from walls."));
    visit(self.weights, plain("weight", "Weights of Eq 9 [radar]."));
    visit(self.nearest, plain("nearest", "Nearest body in the detection circle, from 0."));
    visit(self.best, plain("best", "Index of the beam with the highest score, from 0."));
    visit(self.straight, rad("straight", "Heading taken if nothing is detected, θ_f."));
    visit(self.beams, plain("beams", "Alternative directions."));
  }
};

/// Junction of a map and the channels that lead to the goal through it.
struct Region {
  Vec2 junction{};         ///< centroid of its junction nodes; the goal for region 0 [µm]
  std::uint32_t node = 0;  ///< junction node nearest to the centroid
  std::uint32_t gate = 0;  ///< node of minimum cost, where robots leave the region
  std::uint32_t next = 0;  ///< region entered from the gate; lower than its own number
  std::uint32_t branches = 0;
  bool operator==(const Region&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.junction, um("junction", "Centroid of the junction; the goal for region 0."));
    visit(self.node, plain("node", "Junction node nearest to the centroid."));
    visit(self.gate, plain("gate", "Node where robots leave the region."));
    visit(self.next, plain("next", "Region that they enter from there."));
    visit(self.branches, plain("branches", "Number of branches."));
  }
};

/// Node of the tree of an aggregation.
struct AggregationNode {
  Vec2 position{};           ///< [µm]
  std::uint32_t next = 0;    ///< next node towards the goal, which is its own next
  std::uint32_t region = 0;  ///< ψ of Alg 4 [gather]
  std::uint32_t branch = 0;  ///< φ, from 0 in each region
  bool operator==(const AggregationNode&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.position.x, um("x", "Position to the right."));
    visit(self.position.y, um("y", "Position upwards."));
    visit(self.next, plain("next", "Next node towards the goal, from 0."));
    visit(self.region, plain("region", "Number of its region."));
    visit(self.branch, plain("branch", "Number of its branch within the region."));
  }
};

/// Plan and state of an aggregation, Alg 1–5 [gather]. Nodes and regions are constant from the
/// first step on.
struct AggregationDiagnostics {
  static constexpr std::string_view type_name = "aggregation";
  double mean_distance = 0;                    ///< F(n, t): mean path length to the goal [µm]
  std::optional<std::uint32_t> leader{};       ///< robot that leads; nothing for a rollout
  std::optional<std::uint32_t> team_region{};  ///< of divide and conquer: region of the team
  std::optional<std::uint32_t> team_branch{};  ///< and its branch
  std::optional<std::uint32_t> moves_left{};   ///< of a rollout's plan
  bool is_livelock = false;                    ///< whether random robots lead to break a livelock
  std::vector<AggregationNode> nodes{};
  std::vector<Region> regions{};
  bool operator==(const AggregationDiagnostics&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.mean_distance, um("mean_distance", "Mean path length of the robots to the goal."));
    visit(self.leader, plain("leader", "Robot that leads, from 0."));
    visit(self.team_region, plain("team_region", "Region of the team that is led."));
    visit(self.team_branch, plain("team_branch", "Branch of that team."));
    visit(self.moves_left, plain("moves_left", "Moves left in the plan of a rollout."));
    visit(self.is_livelock, plain("livelock", "1 while random robots lead to break a livelock."));
    visit(self.nodes, plain("nodes", "Tree; a row without has that of an earlier one."));
    visit(self.regions, plain("regions", "Regions; they come with the nodes."));
  }
};

/// Predicted state of a body at one time.
struct PredictedMoment {
  std::uint32_t body = 0;  ///< index in the frame
  double t = 0;            ///< [s]
  Vec2 centre{};           ///< [µm]
  double turn = 0;         ///< rotation since the frame [rad]
  double radius = 0;       ///< of the circle around it, with its growth [µm]
  double growth = 0;       ///< of its outline since the frame [µm]
  double uncertainty = 0;  ///< expected position error [µm]
  bool operator==(const PredictedMoment&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.body, plain("body", "Body, from 0."));
    visit(self.t, s("t", "Time of the prediction."));
    visit(self.centre.x, um("x", "Predicted centre, to the right."));
    visit(self.centre.y, um("y", "Predicted centre, upwards."));
    visit(self.turn, rad("turn", "Rotation since the frame."));
    visit(self.radius, um("radius", "Radius of the circle around it."));
    visit(self.growth, um("growth", "Growth of its outline since the frame."));
    visit(self.uncertainty, um("uncertainty", "Expected error of its position."));
  }
};

/// Corner of the convex outline of a body.
struct PredictedCorner {
  std::uint32_t body = 0;  ///< index in the frame
  Vec2 offset{};           ///< from the centre, before the rotation [µm]
  bool operator==(const PredictedCorner&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.body, plain("body", "Body, from 0."));
    visit(self.offset.x, um("x", "Offset from the centre, to the right."));
    visit(self.offset.y, um("y", "Offset from the centre, upwards."));
  }
};

/// Bodies as the safe-interval navigator predicts them over its horizon.
struct PredictiveDiagnostics {
  static constexpr std::string_view type_name = "predictive";
  double effect = 0;                       ///< time at which the command takes effect [s]
  double radius = 0;                       ///< of the swarm, with the gap [µm]
  std::vector<PredictedMoment> bodies{};   ///< by time, then by body
  std::vector<PredictedCorner> corners{};  ///< of all bodies but discs
  bool operator==(const PredictiveDiagnostics&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.effect, s("effect", "Time at which the command takes effect."));
    visit(self.radius, um("radius", "Radius of the swarm with the gap to obstacles."));
    visit(self.bodies, plain("bodies", "Predicted bodies."));
    visit(self.corners, plain("corners", "Convex outlines of the bodies; none for discs."));
  }
};

/// Decision of the hierarchical D-RRT* framework besides its path and its plan.
struct HierarchicalDiagnostics {
  static constexpr std::string_view type_name = "hierarchical_drrt_star";
  Vec2 towards{};                      ///< goal, or point of the route, that targets lead to [µm]
  double path_clearance = 0;           ///< with which the path was planned [µm]
  bool in_time = false;                ///< whether the path was chosen among predicted obstacles
  bool is_led = false;                 ///< whether the safe-interval navigator leads
  std::optional<double> wait_since{};  ///< time since which it waits for an obstacle to pass [s]
  std::optional<Vec2> wait_at{};       ///< where [µm]
  bool operator==(const HierarchicalDiagnostics&) const = default;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.towards, um("towards", "Goal or point of the route that targets lead to."));
    visit(self.path_clearance, um("path_clearance", "Clearance with which the path was planned."));
    visit(self.in_time, plain("in_time", "1 if chosen among predicted obstacles, else 0."));
    visit(self.is_led, plain("is_led", "1 if the safe-interval navigator leads, else 0."));
    visit(self.wait_since, s("wait_since", "Start of the wait for an obstacle to pass."));
    visit(self.wait_at, um("wait", "Position of the wait."));
  }
};

/// Data behind the command of a navigator's step, for pictures and records; nothing from a
/// navigator that has none, or that did not decide in the step.
using Diagnostics = std::variant<std::monostate, RadarDiagnostics, AggregationDiagnostics,
                                 PredictiveDiagnostics, HierarchicalDiagnostics>;

}  // namespace microswarm
