// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/heap_entry.hpp"
#include "microswarm/planning/path/rrt_star.hpp"
#include "microswarm/planning/path/search_tree.hpp"

namespace microswarm {

/// What every tree planner does besides extending its tree: limits and stopping, samples, counted
/// checks, the choice of parents, and the plan at the end. A planner reads
///
///     for (TreeGrowth growth(...); growth.goes_on();) { … growth.add(parent, p) … }
class TreeGrowth {
 public:
  TreeGrowth(const Snapshot& world, Pose2 start, Vec2 goal, const TreeParams& params, PathCost cost,
             Rng& rng, const Stop& stop);

  const SearchTree& tree() const { return tree_; }
  /// Begins another iteration; false when the planner is done, whatever the reason.
  bool goes_on();
  /// Point of the free space, or with the goal bias the goal (where that is not free: a free point
  /// within its tolerance). Nothing when no free point was drawn.
  std::optional<Vec2> sample();
  /// Is `p` within the goal tolerance?
  bool arrives(Vec2 p) const { return distance(p, goal_) <= params_.goal_tolerance; }
  bool is_free(Segment edge);
  bool is_free(std::span<const Vec2> arc);
  /// Is the edge from `node` to `p` free: straight, or with a turn as the cost says?
  bool edge_is_free(std::uint32_t node, Vec2 p);

  /// New leaf; its edge has been checked. Notes when it has arrived at the goal.
  std::uint32_t add(std::uint32_t parent, Vec2 p);
  /// Looks up the nodes within the planner's radius for the two steps below.
  void find_near(Vec2 p, const RrtStarParams& params);
  /// The node of the neighbourhood with the cheapest free edge to `p`; `nearest` belongs
  /// to it and its edge to `p` has been checked.
  std::uint32_t choose_parent(Vec2 p, std::uint32_t nearest);
  /// Hangs neighbours under `node` where that is cheaper and the edge free; where edges turn, only
  /// those without children, whose edges would be others then.
  void rewire(std::uint32_t node);

  /// The plan; the growth is over after it.
  Plan finish();

 private:
  bool solved() const { return !arrived_.empty(); }
  std::optional<Status> reason_to_end() const;
  std::optional<Vec2> draw(const Box& box, double max_from_goal);

  const Snapshot& world_;
  const TreeParams& params_;
  Rng& rng_;
  const Stop& stop_;
  Vec2 goal_;
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

/// The point `step` on the way from `from` to `to`, or `to` when it is nearer.
Vec2 steer(Vec2 from, Vec2 to, double step);

}  // namespace microswarm
