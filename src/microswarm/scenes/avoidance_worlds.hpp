// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::scenes {

/// Settings of a generated world.
struct AvoidanceOptions {
  bool walls = false;  ///< scattered, with gates, vessels, or a deforming channel
  /// Ratio of the top speed of an obstacle's points to the swarm's speed. Below 1 some obstacles
  /// rest. Moving parts of the walls (valves in gates, the deforming channel) are always slower
  /// than 1.
  double min_speed_ratio = 0.1;
  double max_speed_ratio = 0.9;
  int max_obstacles = 60;  ///< maximum requested; between walls fewer may fit
};

/// Slow worlds, and worlds in which every obstacle moves at 1 to 3 times the swarm's speed.
inline constexpr AvoidanceOptions slow_obstacles{};
inline constexpr AvoidanceOptions fast_obstacles{
    .min_speed_ratio = 1, .max_speed_ratio = 3, .max_obstacles = 30};

/// Minimum gap [µm] of an obstacle to the swarm's edge at t = 0, in addition to its motion in one
/// second.
inline constexpr double avoidance_start_gap = 60;
/// Free space [µm] on both sides of the swarm at its widest, in every passage that is always open.
inline constexpr double avoidance_passage_gap = 30;
/// Maximum fraction of the first minutes during which obstacles are on or too near the goal.
inline constexpr double avoidance_goal_busy = 0.4;

/// Detection range of the metrics, equal for all navigators [µm]: d_r of case I [radar].
inline constexpr double avoidance_detection_range = 70;

/// A vortex-like swarm that crosses a world of obstacles of all shapes and motions, observed with
/// delay, noise and missed frames. Pure function of its arguments. Walls and resting obstacles
/// leave passages for the swarm, so a path from start to goal always exists. Crossing obstacles
/// meet the swarm near its expected position. Tracks contain their samples; the caller must still
/// write their files.
experiment::Scenario avoidance_scenario(std::uint64_t seed, const AvoidanceOptions& options = {});

/// Adds observation noise of up to 2 µm to the obstacles and misses up to 5 % of them per frame;
/// the world is unchanged. Pure function of the scenario.
void see_obstacles_with_noise(experiment::Scenario& scenario);

/// The scenario's world; its map is inline.
World avoidance_world(const experiment::Scenario& scenario);

}  // namespace microswarm::scenes
