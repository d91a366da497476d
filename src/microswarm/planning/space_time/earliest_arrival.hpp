// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/space_time/safe_interval_search.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::planning {

/// A disc that crosses a world at a constant speed, in any direction at once, or waits.
struct ArrivalQuery {
  Vec2 start{};          ///< [µm]
  Vec2 goal{};           ///< [µm]
  double tolerance = 0;  ///< of the goal's GoalArea [µm]
  double radius = 0;     ///< [µm]
  double speed = 0;      ///< [µm/s]
  double cell = 10;      ///< side of a cell [µm]
  double slot = 0.2;     ///< duration of a slot [s]
  double horizon = 200;  ///< time after which obstacles no longer count [s]
  double gap = 0.5;      ///< added to the radius [µm]
};

/// The earliest arrival, a yardstick for navigators.
struct EarliestArrival {
  Status status = Status::no_path;  ///< solved; no_path; stopped or time_limit
  double time = 0;                  ///< [s] after the start
  std::vector<TimedPoint> path{};   ///< ends within the tolerance of the goal
};

/// Earliest arrival of a swarm that knows how all obstacles will move (clairvoyant): no navigator
/// arrives earlier, except for the resolution. Any-angle safe-interval search over the grid's
/// cells; an obstacle occupies a cell during a slot if it is within the radius in the middle of the
/// slot. A start that has less room in the map counts as having enough.
EarliestArrival earliest_arrival(const World& world, const ArrivalQuery& query,
                                 const Stop& stop = {});

}  // namespace microswarm::planning
