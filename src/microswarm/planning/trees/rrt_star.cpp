// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/rrt_star.hpp"

#include <algorithm>

#include "microswarm/planning/trees/tree_growth.hpp"

namespace microswarm::planning {
namespace {

/// RRT*; `accepts(growth, p)` returns whether a node may be added at p.
template <class Accepts>
Plan grow_rrt_star(TreeGrowth growth, const RrtStarParams& params, Accepts&& accepts) {
  while (growth.goes_on()) {
    const std::optional<Vec2> sample = growth.sample();
    if (!sample) continue;
    const std::uint32_t nearest = growth.tree().nearest(*sample);
    const Vec2 from = growth.tree()[nearest].position;
    const Vec2 p = steer(from, *sample, params.step);
    if (p == from || !accepts(growth, p) || !growth.is_free(Segment{from, p})) continue;
    growth.find_near(p, params);
    growth.rewire(growth.add(growth.choose_parent(p, nearest), p));
  }
  return growth.finish();
}

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtStarParams& params, Rng& rng,
          const Stop& stop) {
  return grow_rrt_star({world, start, goal, params, {}, rng, stop}, params,
                       [](const TreeGrowth&, Vec2) { return true; });
}

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const UniformRrtStarParams& params,
          Rng& rng, const Stop& stop) {
  // A node one step from its nearest node is that far away except for rounding.
  const double spacing = std::min(params.spacing, 0.999 * params.step);
  return grow_rrt_star({world, start, goal, params, {}, rng, stop}, params,
                       [&](const TreeGrowth& growth, Vec2 p) {
                         const Vec2 nearest = growth.tree()[growth.tree().nearest(p)].position;
                         return growth.arrives(p) || distance(nearest, p) >= spacing;
                       });
}

}  // namespace microswarm::planning
