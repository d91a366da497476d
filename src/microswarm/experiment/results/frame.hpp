// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/navigator_state.hpp"
#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm::experiment {

/// One tick of a run. All fields are physical and reproducible bit for bit.
struct Frame {
  double t = 0;                     ///< start of the tick [s]
  Pose2 pose{};                     ///< of the swarm at t; on a rig, as last observed
  double radius = 0;                ///< of the swarm at t [µm]; 0 for robots
  double speed = 0;                 ///< of the swarm at t [µm/s]
  double seen = 0;                  ///< exposure time of the navigator's frame [s]
  std::optional<Pose2> observed{};  ///< the swarm in that frame
  Command command{};                ///< the navigator's command
  double goal_distance = 0;   ///< remaining distance to the goal [µm]; see Metrics::goal_distance
  double wall_clearance = 0;  ///< from the centre at t to walls and border [µm]; inf for robots
  double obstacle_clearance = 0;  ///< from the centre at t to moving bodies [µm], or inf
  double avoidance_cost = 0;      ///< δ at t, Eq 4 [radar]
  std::optional<Vec2> target{};   ///< the navigator's local target
  NavigatorState state = NavigatorState::hold;  ///< of the navigator
  bool planned = false;                         ///< a planning event
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "When the tick begins."));
    visit(self.pose.position.x, um("x", "The swarm's centre at t, to the right."));
    visit(self.pose.position.y, um("y", "The swarm's centre at t, upwards."));
    visit(self.pose.heading, rad("heading", "The swarm's heading at t."));
    visit(self.radius, um("radius", "The swarm's radius at t; of robots 0."));
    visit(self.speed, um_per_s("speed", "The swarm's speed at t."));
    visit(self.seen, s("seen", "When the navigator's camera frame was taken."));
    visit(self.observed, plain("observed", "The swarm in that camera frame."));
    visit(self.command.heading, rad("command_heading", "Commanded heading."));
    visit(self.command.speed, um_per_s("command_speed", "Commanded speed; 0 is hold."));
    visit(self.goal_distance,
          um("goal_distance", "Remaining distance to the goal; of robots as in metrics."));
    visit(self.wall_clearance,
          um("wall_clearance", "Distance from the centre to walls; infinite for robots."));
    visit(self.obstacle_clearance,
          um("obstacle_clearance", "Distance from the centre to moving bodies, or infinite."));
    visit(self.avoidance_cost, plain("avoidance_cost", "δ at t, Eq 4 [radar]."));
    visit(self.target, um("target", "The navigator's local target."));
    visit(self.state, plain("state", "State of the navigator; `end` in the last frame."));
    visit(self.planned, plain("planned", "1 for a planning event, else 0."));
  }
};

/// A new path of the navigator, valid until the next one.
struct PathChange {
  double t = 0;  ///< [s]
  std::vector<Vec2> path{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "Time from which the navigator follows it."));
    visit(self.path, um("points", "The path."));
  }
};

/// A new phased goal of a navigator, valid until the next one; see NavigatorView::phased_goal.
struct PhasedGoal {
  double t = 0;  ///< [s]
  std::optional<Vec2> point{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "Time from which the navigator has it."));
    visit(self.point, um("goal", "The phased goal; NaN for the goal of the run."));
  }
};

/// Positions of individually tracked robots.
struct RobotMoment {
  double t = 0;  ///< [s]
  std::vector<Vec2> positions{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "Time of the positions."));
    visit(self.positions, um("places", "Position of each robot."));
  }
};

/// A planning event: the result of the local planner with its tree and detection circles.
struct PlanEvent {
  double t = 0;  ///< [s]
  Plan plan{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "Time of the planning."));
    visit(self.plan.status, plain("status", "How the planner ended."));
    visit(self.plan.counts.iterations, plain("iterations", "Iterations of the planner."));
    visit(self.plan.counts.samples, plain("samples", "Number of samples drawn."));
    visit(self.plan.counts.edge_checks, plain("edge_checks", "Number of edges checked."));
    visit(self.plan.path, um("path", "Path found."));
    visit(self.plan.tree, plain("tree", "Search tree."));
    visit(self.plan.detections, plain("detections", "Detection circles."));
  }
};

/// A change of a scenario value between two ticks.
struct Change {
  double t = 0;             ///< start of the following frame [s]
  std::uint64_t frame = 0;  ///< index of that frame, from 0
  std::string setting{};    ///< "navigator.speed_um_per_s=60"
};

/// Kind of a run event.
enum class EventKind {
  contact_wall,
  contact_obstacle,
  goal_reached,
  hold_begins,
  hold_ends,
  robots_unseen
};
constexpr auto enum_names(EventKind) {
  return std::array<std::pair<EventKind, std::string_view>, 6>{
      {{EventKind::contact_wall, "contact_wall"},
       {EventKind::contact_obstacle, "contact_obstacle"},
       {EventKind::goal_reached, "goal_reached"},
       {EventKind::hold_begins, "hold_begins"},
       {EventKind::hold_ends, "hold_ends"},
       {EventKind::robots_unseen, "robots_unseen"}}};
}

/// An event with its time between ticks.
struct RunEvent {
  double t = 0;  ///< [s]
  EventKind kind = EventKind::goal_reached;
  Vec2 position{};       ///< of the swarm's centre [µm]
  double clearance = 0;  ///< of the centre at t [µm]
  double speed = 0;      ///< of the swarm at t [µm/s]; 0 if it was hit while holding
  /// Index of the touched wall piece or obstacle, or number of robots that are unseen.
  std::uint32_t body = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "Time of the event, also between ticks."));
    visit(self.kind, plain("kind", "Kind of the event."));
    visit(self.position.x, um("x", "The swarm's centre at the event, to the right."));
    visit(self.position.y, um("y", "The swarm's centre at the event, upwards."));
    visit(self.clearance, um("clearance", "Distance from the centre at a contact."));
    visit(self.speed, um_per_s("speed", "The swarm's speed at the event."));
    visit(self.body, plain("body", "Obstacle touched, 4294967295: border; or unseen robots."));
  }
};

}  // namespace microswarm::experiment
