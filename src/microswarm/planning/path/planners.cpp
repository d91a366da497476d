// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/path/planners.hpp"

namespace microswarm::planning {

/// A planner without its own function would otherwise be taken for its base, or for any
/// planner.
template <class Forgotten>
Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const Forgotten& params, Rng& rng,
          const Stop& stop) = delete;

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const PlannerParams& params, Rng& rng,
          const Stop& stop) {
  return std::visit([&](const auto& chosen) { return plan(world, start, goal, chosen, rng, stop); },
                    params);
}

}  // namespace microswarm::planning
