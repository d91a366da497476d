// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::scenes {

/// What a generated world is like.
struct AvoidanceOptions {
  bool walls = false;  ///< scattered ones, walls with gates, vessels, or a deforming channel
  /// Of the top speed of an obstacle's points to the swarm's speed. Below 1 some obstacles stand;
  /// what belongs to the walls (valves in gates, the deforming channel) is slower than 1 always.
  double min_speed_ratio = 0.1;
  double max_speed_ratio = 0.9;
  int max_obstacles = 60;  ///< 1 … most are asked for; between walls fewer may fit
};

/// Slow worlds, and those with every obstacle at 1 to 3 times the swarm's speed.
inline constexpr AvoidanceOptions slow_obstacles{};
inline constexpr AvoidanceOptions fast_obstacles{
    .min_speed_ratio = 1, .max_speed_ratio = 3, .max_obstacles = 30};

/// No obstacle is nearer to the swarm's edge at t = 0 than this [µm] and what it moves in a second.
inline constexpr double avoidance_start_gap = 60;
/// Room [µm] on both sides of the swarm at its widest, in every passage that is always open.
inline constexpr double avoidance_passage_gap = 30;
/// Greatest share of the first minutes in which obstacles are on the goal or too near to it.
inline constexpr double avoidance_goal_busy = 0.4;

/// Of the metrics, for every navigator the same [µm]: d_r of case I [radar].
inline constexpr double avoidance_detection_range = 70;

/// A vortex-like swarm that has to cross a world of obstacles of all shapes and motions, seen with
/// delay, noise and missed frames. A pure function of its arguments. What stands still, walls
/// included, leaves passages for the swarm, so that a way from start to goal always exists; what
/// comes straight through meets the swarm about where it is by then. Tracks hold their samples, but
/// their file is yet to be written.
Scenario avoidance_scenario(std::uint64_t seed, const AvoidanceOptions& options = {});

/// Obstacles are seen with noise of up to 2 µm and up to 5 % of them are not found in a frame: the
/// same world, another sight. A pure function of the scenario.
void see_obstacles_with_noise(Scenario& scenario);

/// The scenario's world. Its map is written down in place.
World avoidance_world(const Scenario& scenario);

}  // namespace microswarm::scenes
