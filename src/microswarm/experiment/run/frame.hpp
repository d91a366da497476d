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
#include "microswarm/core/fields.hpp"

namespace microswarm {

/// One tick of a run. Everything here is physical: it repeats bit for bit.
struct Frame {
  double t = 0;                   ///< when the tick begins [s]
  Pose2 pose;                     ///< where the swarm is at t (what was last seen, on a rig)
  double radius = 0;              ///< of the swarm at t [µm]; of robots 0
  double speed = 0;               ///< of the swarm at t [µm/s]
  double seen = 0;                ///< when the frame that the navigator got was taken [s]
  std::optional<Pose2> observed;  ///< the swarm in that frame
  Command command;                ///< what the navigator answered
  double goal_distance = 0;       ///< what is left to the goal [µm]; see Metrics::goal_distance
  double wall_clearance = 0;      ///< from the centre at t to walls and border [µm]; of robots inf
  double obstacle_clearance = 0;  ///< from the centre at t to moving bodies [µm]; inf without any
  double avoidance_cost = 0;      ///< δ at t, Eq 4 [radar]
  std::optional<Vec2> target;     ///< the navigator's local target
  NavigatorState state = NavigatorState::hold;  ///< what the navigator does
  bool planned = false;                         ///< a planning event
};

/// A path that the navigator began to follow; it follows it until the next one.
struct PathChange {
  double t = 0;  ///< [s]
  std::vector<Vec2> path;
};

/// Where robots that are told apart are.
struct RobotMoment {
  double t = 0;  ///< [s]
  std::vector<Vec2> places;
};

/// A planning event: what the local planner returned, its tree and detection circles included.
struct PlanEvent {
  double t = 0;  ///< [s]
  Plan plan;
};

/// A value of the scenario that was changed between two ticks.
struct Change {
  double t = 0;             ///< of the frame that it comes before [s]
  std::uint64_t frame = 0;  ///< that frame, from 0
  std::string setting;      ///< "navigator.speed_um_per_s=60"
};

/// What can happen to a swarm.
enum class EventKind { contact_wall, contact_obstacle, goal_reached, hold_begins, hold_ends };
constexpr auto enum_names(EventKind) {
  return std::array<std::pair<EventKind, std::string_view>, 5>{
      {{EventKind::contact_wall, "contact_wall"},
       {EventKind::contact_obstacle, "contact_obstacle"},
       {EventKind::goal_reached, "goal_reached"},
       {EventKind::hold_begins, "hold_begins"},
       {EventKind::hold_ends, "hold_ends"}}};
}

/// Something that happened, at its own time between the ticks.
struct RunEvent {
  double t = 0;  ///< [s]
  EventKind kind = EventKind::goal_reached;
  Vec2 position{};         ///< of the swarm's centre [µm]
  double clearance = 0;    ///< of the centre at t [µm]
  double speed = 0;        ///< of the swarm at t [µm/s]: 0 when it was run into while holding
  std::uint32_t body = 0;  ///< wall piece or obstacle that was touched
};

}  // namespace microswarm
