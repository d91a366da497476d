// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/maths/heap_entry.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/trees/rrt_star.hpp"
#include "microswarm/planning/trees/search_tree.hpp"

namespace microswarm::planning {

/// Common part of the tree planners: limits and stopping, samples, counted checks, the choice of
/// parents, and the final plan. A planner reads
///
///     for (TreeGrowth growth(...); growth.goes_on();) { … growth.add(parent, p) … }
class TreeGrowth {
 public:
  TreeGrowth(const Snapshot& world, Pose2 start, Vec2 goal, const TreeParams& params, PathCost cost,
             Rng& rng, const Stop& stop);

  const SearchTree& tree() const { return tree_; }
  /// Begins another iteration; false if the planner is done, for any reason.
  bool goes_on();
  /// Free point or, with the goal bias, the goal (if that is not free: a free point within its
  /// tolerance). Nothing if no free point was drawn.
  std::optional<Vec2> sample();
  /// Whether the goal is reached at `p`.
  bool arrives(Vec2 p) const { return goal_area_.contains(p); }
  bool is_free(Segment edge);
  bool is_free(std::span<const Vec2> arc);
  /// Whether every arc of this length from `p` is clearly free, which then counts as a check.
  bool is_open(Vec2 p, double length);
  /// Whether the edge from `node` to `p` is free: straight, or with a turn as given by the cost.
  bool edge_is_free(std::uint32_t node, Vec2 p);

  /// Adds a leaf whose edge has been checked; records whether it reaches the goal.
  std::uint32_t add(std::uint32_t parent, Vec2 p);
  /// Finds the nodes within the planner's radius for the two steps below.
  void find_near(Vec2 p, const RrtStarParams& params);
  /// Node of the neighbourhood with the cheapest free edge to `p`. `nearest` is one of the
  /// candidates, and its edge to `p` has been checked.
  std::uint32_t choose_parent(Vec2 p, std::uint32_t nearest);
  /// Moves neighbours to `node` as their parent where that is cheaper and the edge free. With
  /// turning edges, only neighbours without children, since their children's edges would change.
  void rewire(std::uint32_t node);

  /// Returns the plan and ends the growth.
  Plan finish();

 private:
  bool solved() const { return !arrived_.empty(); }
  std::optional<Status> reason_to_end() const;
  template <class Draw>
  std::optional<Vec2> draw_free(Draw&& draw);
  std::optional<Vec2> draw_free_uniform();

  const Snapshot& world_;
  const TreeParams& params_;
  Rng& rng_;
  const Stop& stop_;
  Vec2 goal_;
  GoalArea goal_area_;
  bool goal_is_free_ = false;
  Box sampled_;
  PathCost cost_;
  SearchTree tree_;
  std::vector<Vec2> chords_;
  PlanCounts counts_;
  std::optional<Status> ended_;
  std::vector<std::uint32_t> arrived_;  ///< nodes within the goal tolerance
  std::vector<std::uint32_t> near_;
  std::vector<HeapEntry<double>> candidates_;
};

/// Random point of the box by TreeParams; one of a lattice may lie just outside.
template <class Params>
Vec2 sample_in(const Box& box, const Params& params, Rng& rng) {
  constexpr double on_lattice = 0.9;  // of the samples
  const Vec2 p = uniform_in(box, rng);
  if (params.sample_pitch == 0 || rng.uniform() >= on_lattice) return p;
  const Vec2 cells = (p - params.sample_origin) / params.sample_pitch;
  return params.sample_origin +
         params.sample_pitch * Vec2{std::round(cells.x), std::round(cells.y)};
}

/// Point at distance `step` from `from` towards `to`, or `to` if it is nearer.
Vec2 steer(Vec2 from, Vec2 to, double step);

}  // namespace microswarm::planning
