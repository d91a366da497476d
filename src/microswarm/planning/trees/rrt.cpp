// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/rrt.hpp"

#include "microswarm/planning/trees/tree_growth.hpp"

namespace microswarm::planning {

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtParams& params, Rng& rng,
          const Stop& stop) {
  TreeGrowth growth(world, start, goal, params, {}, rng, stop);
  while (growth.goes_on()) {
    const std::optional<Vec2> sample = growth.sample();
    if (!sample) continue;
    const std::uint32_t nearest = growth.tree().nearest(*sample);
    const Vec2 from = growth.tree()[nearest].position;
    const Vec2 p = steer(from, *sample, params.step);
    if (p == from || !growth.is_free(Segment{from, p})) continue;
    growth.add(nearest, p);
  }
  return growth.finish();
}

}  // namespace microswarm::planning
