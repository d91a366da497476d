// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/config/type.hpp"
#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/path/planner_params.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::experiment {

/// Path query in a map.
struct PathQuery {
  Pose2 start{};
  Vec2 goal{};
  /// Of keys within `planner`. Other values are fitted to the map, see fit_to_map.
  Settings settings{};
  std::uint64_t seed = 1;
};

/// Values that the settings of a query may change.
const Type& path_settings();

/// Answer to a query: the plan, and the planner's parameters and time.
struct PathAnswer {
  Plan plan{};
  planning::PlannerParams planner{};  ///< parameters that were used
  double seconds = 0;                 ///< computing time of the planner [s]
  Notes notes{};  ///< former keys in the settings, and a path that ends beside its goal

  /// Why there is no path, as text, with the limit that ended the search; empty with a path.
  std::string why_none() const;
};

/// Plans a path with the planner of the settings, by default the shortest one. `name` is the map's
/// name in messages. Throws InputError for numbers that are not finite, mistakes in the settings,
/// and if no path can exist: a blocked start, a goal in a wall or outside the map, one without a
/// free place within the tolerance, a swarm too wide, or a goal that is cut off. A goal that is
/// only nearer to a wall than the clearance is noted, with the distance to where the path ends.
PathAnswer answer(const Snapshot& world, const PathQuery& query, const std::string& name,
                  const Stop& stop = {});

/// Clearance and tolerance of the goal [µm] of a planner.
struct PathLimits {
  double clearance = 0;
  double goal_tolerance = 0;
};
PathLimits path_limits(const planning::PlannerParams& planner);

/// Planner and values as a JSON object.
std::string planner_json(const planning::PlannerParams& planner);

}  // namespace microswarm::experiment
