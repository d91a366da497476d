// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/rrt_connect.hpp"

#include <array>
#include <utility>

#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/trees/search_tree.hpp"
#include "microswarm/planning/trees/tree_growth.hpp"

namespace microswarm::planning {
namespace {

class RrtConnect {
 public:
  RrtConnect(const Snapshot& world, Pose2 start, Vec2 goal, Vec2 target,
             const RrtConnectParams& params, Rng& rng)
      : world_(world),
        params_(params),
        rng_(rng),
        goal_(goal),
        goal_area_(world.map(), goal, params.goal_tolerance),
        sampled_(world.bounds().grown(-params.clearance)),
        trees_{SearchTree(world.bounds(), start, {}), SearchTree(world.bounds(), {target, 0}, {})} {
  }

  Plan run(const Stop& stop) {
    if (arrives()) return finish(Status::solved, 0);
    Status status = Status::solved;
    // The tree that grows towards a sample, and the one that then grows towards it.
    std::size_t growing = 0;
    for (; !is_free(end(0), end(1)); growing = 1 - growing) {
      if (const auto told = reason_to_end(stop)) {
        status = *told;
        break;
      }
      ++counts_.iterations;
      ++counts_.samples;
      if (!extend(growing, sample(growing))) continue;
      if (growing == 0 && arrives()) return finish(Status::solved, met_[0]);
      if (connect(1 - growing, end(growing))) break;
    }
    return finish(status);
  }

 private:
  Vec2 end(std::size_t tree) const { return trees_[tree][met_[tree]].position; }

  bool arrives() const { return goal_area_.contains(end(0)); }

  bool is_free(Vec2 a, Vec2 b) {
    ++counts_.edge_checks;
    return world_.is_free(Segment{a, b}, params_.clearance);
  }

  std::optional<Status> reason_to_end(const Stop& stop) const {
    if (trees_[0].size() + trees_[1].size() >= static_cast<std::uint32_t>(params_.max_nodes) ||
        counts_.iterations >= static_cast<std::uint64_t>(params_.max_iterations))
      return Status::node_limit;
    return counts_.iterations % 64 == 0 ? stop.status() : std::nullopt;
  }

  /// Anywhere; for the first tree, if the goal is blocked, sometimes beside it, since the place
  /// found there for the other tree can be in a pocket.
  Vec2 sample(std::size_t tree) {
    constexpr double bias = 0.1;
    const Vec2 target = trees_[1][0].position;
    if (tree != 0 || target == goal_ || rng_.uniform() >= bias)
      return sample_in(sampled_, params_, rng_);
    const Vec2 reach{params_.goal_tolerance, params_.goal_tolerance};
    return uniform_in({goal_ - reach, goal_ + reach}, rng_);
  }

  /// One step from the tree's nearest node towards `p`, which becomes its end.
  bool extend(std::size_t tree, Vec2 p) {
    const std::uint32_t nearest = trees_[tree].nearest(p);
    const Vec2 from = trees_[tree][nearest].position;
    const Vec2 to = steer(from, p, params_.step);
    if (to == from || !is_free(from, to)) return false;
    met_[tree] = trees_[tree].add(nearest, to);
    return true;
  }

  /// Steps from the tree's nearest node towards `p` until a wall or `p` itself, which its end then
  /// sees.
  bool connect(std::size_t tree, Vec2 p) {
    met_[tree] = trees_[tree].nearest(p);
    if (end(tree) == p || is_free(end(tree), p)) return true;
    while (trees_[tree].size() < static_cast<std::uint32_t>(params_.max_nodes)) {
      const Vec2 from = end(tree);
      const Vec2 to = steer(from, p, params_.step);
      if (to == p || !is_free(from, to)) return false;
      met_[tree] = trees_[tree].add(met_[tree], to);
    }
    return false;
  }

  /// The trees have met, or the search has ended.
  Plan finish(Status status) {
    SearchTree& tree = trees_[0];
    if (status != Status::solved) return finish(status, tree.nearest(trees_[1][0].position));
    // The other's branch leads to its root.
    std::uint32_t last = met_[0];
    for (std::uint32_t node = met_[1];; node = trees_[1][node].parent) {
      const Vec2 p = trees_[1][node].position;
      if (p != tree[last].position) last = tree.add(last, p);
      if (node == 0) return finish(status, last);
    }
  }
  Plan finish(Status status, std::uint32_t last) {
    Plan plan{.status = status, .counts = counts_};
    plan.tree = trees_[0].take_nodes();
    plan.path = path_to(plan.tree, last);
    return plan;
  }

  const Snapshot& world_;
  const RrtConnectParams& params_;
  Rng& rng_;
  Vec2 goal_;
  GoalArea goal_area_;
  Box sampled_;
  std::array<SearchTree, 2> trees_;     ///< from the start, from the goal
  std::array<std::uint32_t, 2> met_{};  ///< of each tree: its newest end
  PlanCounts counts_;
};

}  // namespace

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const RrtConnectParams& params, Rng& rng,
          const Stop& stop) {
  const Target target =
      find_target(world, start.position, goal, params.goal_tolerance, params.clearance);
  if (target.fault) return target.blocked(start.position);
  return RrtConnect(world, start, goal, target.position, params, rng).run(stop);
}

}  // namespace microswarm::planning
