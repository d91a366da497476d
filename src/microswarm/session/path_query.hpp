// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/config/type.hpp"
#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/path/planner_params.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// A path that is asked for in a map.
struct PathQuery {
  Pose2 start;
  Vec2 goal;
  /// `planner.KEY=VALUE`, as from --set. What is not set is fitted to the map, see fit_to_map.
  std::vector<std::string> settings{};
  std::uint64_t seed = 1;
};

/// What the settings of a query may change.
const Type& path_settings();

/// The answer to a query: the plan, and how it was made.
struct PathAnswer {
  Plan plan;
  PlannerParams planner;  ///< with the values that were used
  double seconds = 0;     ///< that the planner took
  Notes notes{};          ///< one for each outdated key in the settings

  /// Why there is no path, in words, with the limit that ended the search; empty with a path.
  std::string why_none() const;
};

/// Plans a path with the planner of the settings, or the shortest one. `name` stands for the map in
/// messages. Throws InputError for numbers that are not finite, mistakes in the settings, and where
/// no path can exist: a blocked start or goal, a swarm too wide, or a goal that is cut off.
PathAnswer answer(const Snapshot& world, const PathQuery& query, const std::string& name,
                  const Stop& stop = {});

/// Clearance and tolerance of the goal [µm] of a planner.
struct PathLimits {
  double clearance = 0;
  double goal_tolerance = 0;
};
PathLimits limits_of(const PlannerParams& planner);

/// Planner and values as a JSON object.
std::string planner_json(const PlannerParams& planner);

}  // namespace microswarm
