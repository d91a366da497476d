// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/fmt_star.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/heap_entry.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/trees/sample_buckets.hpp"

namespace microswarm::planning {
namespace {

constexpr std::uint64_t draws_per_sample = 200;  // maximum, on average
constexpr std::uint64_t between_stops = 64;
constexpr double min_radius = 1e-3;  // [µm], for a space without area

constexpr std::uint32_t blocked_flag = 1u << 31;

/// FMT* search. Samples are numbered: 0 is the start, 1 the goal.
class FmtStar {
 public:
  FmtStar(const Snapshot& world, Pose2 start, Vec2 goal, Vec2 free_goal,
          const FmtStarParams& params, Rng& rng, const Stop& stop)
      : world_(world),
        start_(start),
        goal_(goal),
        goal_area_(world.map(), goal, params.goal_tolerance),
        params_(params),
        rng_(rng),
        stop_(stop),
        sampled_(world.bounds().grown(-params.clearance)),
        samples_{start.position, free_goal} {}

  Plan run() {
    const auto most = static_cast<std::size_t>(params_.max_nodes);
    for (std::size_t n = static_cast<std::size_t>(params_.samples);; n *= 2) {
      draw(std::min(n, most));
      grow();
      if (ended_) break;
      if (n >= most) ended_ = Status::node_limit;
    }
    return finish();
  }

 private:
  /// Neighbours of a sample: a range in neighbours_.
  struct Run {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    bool known = false;
  };

  bool told_to_stop(std::uint64_t count) {
    if (count % between_stops == 0)
      if (const auto told = stop_.status()) ended_ = told;
    return ended_.has_value();
  }
  void draw(std::size_t count);
  void begin();
  void grow();
  void expand(std::uint32_t z);
  void try_to_join(std::uint32_t x);
  Run neighbours(std::uint32_t sample);
  Plan finish();

  const Snapshot& world_;
  Pose2 start_;
  Vec2 goal_;
  GoalArea goal_area_;
  const FmtStarParams& params_;
  Rng& rng_;
  const Stop& stop_;
  Box sampled_;
  std::vector<Vec2> samples_;
  SampleBuckets buckets_;
  PlanCounts counts_;
  std::optional<Status> ended_;

  std::vector<bool> visited_;              ///< per sample
  std::vector<double> open_costs_;         ///< per sample: its cost-to-come, infinity if not open
  std::vector<std::uint32_t> nodes_;       ///< tree node of each visited sample
  std::vector<Run> runs_;                  ///< per sample
  std::vector<std::uint32_t> neighbours_;  ///< with the mark `blocked` on edges that are not free
  std::vector<HeapEntry<double>> open_;    ///< samples the tree grows from, a heap
  std::vector<std::uint32_t> joined_;      ///< V_open,new
  std::vector<TreeNode> tree_;
  std::vector<std::uint32_t> samples_of_;  ///< sample of each node
  std::uint32_t arrived_ = 0;              ///< node
};

void FmtStar::draw(std::size_t count) {
  const std::uint64_t most = counts_.samples + draws_per_sample * count;
  while (samples_.size() < count + 2 && counts_.samples < most) {
    if (told_to_stop(counts_.samples)) return;
    ++counts_.samples;
    const Vec2 p = uniform_in(sampled_, rng_);
    if (world_.is_free(p, params_.clearance)) samples_.push_back(p);
  }
  const double hits = static_cast<double>(samples_.size() - 1);
  const double draws = static_cast<double>(counts_.samples + 1);
  const double area = sampled_.width() * sampled_.height() * std::min(1.0, hits / draws);
  const double radius = fmt_radius(params_.radius_factor, area, samples_.size());
  buckets_ = SampleBuckets(samples_, std::max(radius, min_radius));
}

void FmtStar::begin() {
  visited_.assign(samples_.size(), false);
  open_costs_.assign(samples_.size(), infinity);
  nodes_.assign(samples_.size(), 0);
  runs_.assign(samples_.size(), {});
  neighbours_.clear();
  tree_.assign(1, {start_.position, start_.heading, 0, 0});
  samples_of_.assign(1, 0);
  open_.assign(1, {0, 0});
  visited_[0] = true;
  open_costs_[0] = 0;
}

void FmtStar::grow() {
  if (ended_) return;
  begin();
  while (!open_.empty()) {
    if (told_to_stop(counts_.iterations)) return;
    ++counts_.iterations;
    std::pop_heap(open_.begin(), open_.end());
    const std::uint32_t node = open_.back().node;
    open_.pop_back();
    if (goal_area_.contains(tree_[node].position)) {
      arrived_ = node;
      ended_ = Status::solved;
      return;
    }
    expand(samples_of_[node]);
  }
}

void FmtStar::expand(std::uint32_t z) {
  joined_.clear();
  const Run near = neighbours(z);
  for (std::uint32_t i = near.first; i < near.last; ++i)
    if (const std::uint32_t x = neighbours_[i] & ~blocked_flag; !visited_[x]) try_to_join(x);
  for (const std::uint32_t x : joined_) {
    const double cost = tree_[nodes_[x]].cost;
    open_costs_[x] = cost;
    open_.push_back({cost, nodes_[x]});
    std::push_heap(open_.begin(), open_.end());
  }
  open_costs_[z] = infinity;
}

/// Connects x to the open neighbour that gives the lowest cost ignoring walls, if that edge is
/// free. Otherwise x waits until another neighbour is the cheapest.
void FmtStar::try_to_join(std::uint32_t x) {
  const Run near = neighbours(x);
  const Vec2 p = samples_[x];
  double least = infinity;
  std::uint32_t* best = nullptr;
  for (std::uint32_t i = near.first; i < near.last; ++i) {
    const std::uint32_t y = neighbours_[i] & ~blocked_flag;
    if (open_costs_[y] >= least) continue;
    const double cost = open_costs_[y] + distance(samples_[y], p);
    if (cost >= least) continue;
    least = cost;
    best = &neighbours_[i];
  }
  if (!best || (*best & blocked_flag) != 0) return;
  const Vec2 from = samples_[*best];
  ++counts_.edge_checks;
  if (!world_.is_free(Segment{from, p}, params_.clearance)) {
    *best |= blocked_flag;
    return;
  }
  nodes_[x] = static_cast<std::uint32_t>(tree_.size());
  tree_.push_back({p, heading_along(p - from), least, nodes_[*best]});
  samples_of_.push_back(x);
  joined_.push_back(x);
  visited_[x] = true;
}

Plan FmtStar::finish() {
  Plan plan;
  plan.status = *ended_;
  plan.counts = counts_;
  if (tree_.empty()) begin();
  std::uint32_t last = arrived_;
  if (plan.status != Status::solved) {
    const auto nearer = [&](const TreeNode& a, const TreeNode& b) {
      return distance(a.position, goal_) < distance(b.position, goal_);
    };
    last = static_cast<std::uint32_t>(std::min_element(tree_.begin(), tree_.end(), nearer) -
                                      tree_.begin());
  }
  plan.path = path_to(tree_, last);
  plan.tree = std::move(tree_);
  return plan;
}

FmtStar::Run FmtStar::neighbours(std::uint32_t sample) {
  Run& run = runs_[sample];
  if (run.known) return run;
  run.known = true;
  run.first = static_cast<std::uint32_t>(neighbours_.size());
  buckets_.append_near(samples_[sample], neighbours_);
  run.last = static_cast<std::uint32_t>(neighbours_.size());
  return run;
}

}  // namespace

Issues validate(const FmtStarParams& params) {
  Issues issues;
  if (params.max_nodes < params.samples)
    issues.add({"max_nodes", "samples"}, "max_nodes is " + std::to_string(params.max_nodes) +
                                             ", less than samples, " +
                                             std::to_string(params.samples));
  return issues;
}

double fmt_radius(double radius_factor, double area, std::size_t n) {
  const double count = static_cast<double>(std::max<std::size_t>(2, n));
  return 2 * radius_factor * std::sqrt(0.5 * area / pi * maths::log(count) / count);
}

Plan plan(const Snapshot& world, Pose2 start, Vec2 goal, const FmtStarParams& params, Rng& rng,
          const Stop& stop) {
  const Target target =
      find_target(world, start.position, goal, params.goal_tolerance, params.clearance);
  if (target.fault) return target.blocked(start.position);
  return FmtStar(world, start, goal, target.position, params, rng, stop).run();
}

}  // namespace microswarm::planning
