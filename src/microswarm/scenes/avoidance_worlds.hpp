// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::scenes {

/// Difficulty of a world besides its obstacles.
enum class Hardship {
  none,
  turn_limit,    ///< the swarm is a ribbon, which turns at a limited rate
  drift,         ///< a flow carries it, and it is slower than commanded; navigators know of neither
  dead_ends,     ///< walls form pockets that open towards the start
  narrow_lanes,  ///< the only passages are 15 µm wider than the swarm
  blocked_gates,      ///< one of two gates is shut by something that rests in it
  lost_sight,         ///< swarm and obstacles stay unseen for a time
  mistaken_identity,  ///< obstacles that are near each other are mistaken in some frames
  hidden_delay,       ///< frames are older than navigators know
};
constexpr auto enum_names(Hardship) {
  return std::array<std::pair<Hardship, std::string_view>, 9>{
      {{Hardship::none, "none"},
       {Hardship::turn_limit, "turn limit"},
       {Hardship::drift, "drift"},
       {Hardship::dead_ends, "dead ends"},
       {Hardship::narrow_lanes, "narrow lanes"},
       {Hardship::blocked_gates, "blocked gates"},
       {Hardship::lost_sight, "lost sight"},
       {Hardship::mistaken_identity, "mistaken identity"},
       {Hardship::hidden_delay, "hidden delay"}}};
}

/// Settings of a generated world.
struct AvoidanceOptions {
  bool walls = false;  ///< scattered, with gates, vessels, or a deforming channel
  /// Ratio of the top speed of an obstacle's points to the swarm's speed. Below 1 some obstacles
  /// rest. Moving parts of the walls (valves in gates, the deforming channel) are always slower
  /// than 1.
  double min_speed_ratio = 0.1;
  double max_speed_ratio = 0.9;
  int max_obstacles = 60;  ///< maximum requested; between walls fewer may fit
  /// Whether obstacles on waypoints turn in no time; else at 1.5 rad/s at most.
  bool turn_at_once = true;
  Hardship hardship = Hardship::none;
};

/// Slow worlds, and worlds in which every obstacle moves at 1 to 3 times the swarm's speed.
inline constexpr AvoidanceOptions slow_obstacles{};
inline constexpr AvoidanceOptions fast_obstacles{
    .min_speed_ratio = 1, .max_speed_ratio = 3, .max_obstacles = 30};

/// The world of a seed in the course of a hardship: obstacles turn at a limited rate, and every
/// other world has walls unless the hardship shapes them.
AvoidanceOptions hardship_options(Hardship hardship, std::uint64_t seed);

/// Minimum gap [µm] of an obstacle to the swarm's edge at t = 0, in addition to its motion in one
/// second.
inline constexpr double avoidance_start_gap = 60;
/// Free space [µm] on both sides of the swarm at its widest, in every passage that is always open.
inline constexpr double avoidance_passage_gap = 30;
/// The same with a hardship: less in narrow lanes [µm].
constexpr double passage_gap(Hardship hardship) {
  return hardship == Hardship::narrow_lanes ? 7.5 : avoidance_passage_gap;
}
/// Maximum fraction of the first minutes during which obstacles are on or too near the goal.
inline constexpr double avoidance_goal_busy = 0.4;

/// Detection range of the metrics, equal for all navigators [µm]: d_r of case I [radar].
inline constexpr double avoidance_detection_range = 70;

/// A swarm, vortex-like unless the hardship says otherwise, that crosses a world of obstacles of
/// all shapes and motions, observed with delay, noise and missed frames. Pure function of its
/// arguments. Walls and resting obstacles leave passages for the swarm, so a path from start to
/// goal always exists. Crossing obstacles meet the swarm near its expected position. Tracks contain
/// their samples; the caller must still write their files.
experiment::Scenario avoidance_scenario(std::uint64_t seed, const AvoidanceOptions& options = {});

/// Adds observation noise of up to 2 µm to the obstacles and misses up to 5 % of them per frame;
/// the world is unchanged. Pure function of the scenario.
void see_obstacles_with_noise(experiment::Scenario& scenario);

/// The scenario's world; its map is inline.
World avoidance_world(const experiment::Scenario& scenario);

}  // namespace microswarm::scenes
