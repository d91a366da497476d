// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/tree_growth.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/trees/turn_edge.hpp"

namespace microswarm::planning {
namespace {

constexpr std::size_t max_sample_draws = 200;

/// A root at a non-finite position would break the tree's grid; it is reported as blocked.
Pose2 finite(Pose2 pose) { return is_finite(pose.position) ? pose : Pose2{}; }

/// Radius of RRT*, γ √(log n / n), with γ above the bound 2 √(1 + 1/2) √(area / π) of Karaman and
/// Frazzoli, Theorem 38. The area of the bounds replaces that of the free space.
double shrinking_radius(double area, std::uint32_t nodes) {
  const double n = std::max(2u, nodes);
  return 2.0 * std::sqrt(1.5 * area / pi * maths::log(n) / n);
}

}  // namespace

TreeGrowth::TreeGrowth(const Snapshot& world, Pose2 start, Vec2 goal, const TreeParams& params,
                       PathCost cost, Rng& rng, const Stop& stop)
    : world_(world),
      params_(params),
      rng_(rng),
      stop_(stop),
      goal_(goal),
      goal_area_(world.map(), goal, params.goal_tolerance),
      sampled_(world.bounds().grown(-params.clearance)),
      cost_(cost),
      tree_(world.bounds(), finite(start), cost) {
  ended_ = find_target(world, start.position, goal, params.goal_tolerance, params.clearance).fault;
  if (ended_) return;
  goal_is_free_ = world.is_free(goal, params.clearance);
  if (arrives(start.position)) arrived_.push_back(0);
}

std::optional<Status> TreeGrowth::reason_to_end() const {
  if (solved() && params_.stop_at_first) return Status::solved;
  if (tree_.size() >= static_cast<std::uint32_t>(params_.max_nodes) ||
      counts_.iterations >= static_cast<std::uint64_t>(params_.max_iterations)) {
    return Status::node_limit;
  }
  return stop_.status();
}

bool TreeGrowth::goes_on() {
  if (!ended_) ended_ = reason_to_end();
  if (ended_) return false;
  ++counts_.iterations;
  return true;
}

template <class Draw>
std::optional<Vec2> TreeGrowth::draw_free(Draw&& draw) {
  for (std::size_t i = 0; i < max_sample_draws; ++i) {
    const std::optional<Vec2> p = draw();
    if (p && world_.is_free(*p, params_.clearance)) return p;
  }
  return std::nullopt;
}

/// The same as drawing a point of the box until one is free, but after a first one looks up several
/// at a time: where many are not free, which one is free is hard to predict.
std::optional<Vec2> TreeGrowth::draw_free_uniform() {
  const Vec2 first = uniform_in(sampled_, rng_);
  if (world_.is_free(first, params_.clearance)) return first;
  std::array<Vec2, Rng::max_ahead / 2> some;
  for (std::size_t drawn = 1; drawn < max_sample_draws; drawn += some.size()) {
    const auto positions = std::span(some).first(std::min(some.size(), max_sample_draws - drawn));
    look_ahead(sampled_, rng_, positions);
    for (unsigned left = world_.map().may_be_free(positions, params_.clearance); left != 0;
         left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      if (!world_.is_free(positions[k], params_.clearance)) continue;
      rng_.skip(2 * (k + 1));
      return positions[k];
    }
    rng_.skip(2 * positions.size());
  }
  return std::nullopt;
}

std::optional<Vec2> TreeGrowth::sample() {
  ++counts_.samples;
  if (rng_.uniform() >= params_.goal_bias)
    return params_.sample_pitch == 0
               ? draw_free_uniform()
               : draw_free([&] { return std::optional(sample_in(sampled_, params_, rng_)); });
  if (goal_is_free_) return goal_;
  const Vec2 reach{params_.goal_tolerance, params_.goal_tolerance};
  return draw_free([&] {
    const Vec2 p = uniform_in({goal_ - reach, goal_ + reach}, rng_);
    return arrives(p) ? std::optional(p) : std::nullopt;
  });
}

bool TreeGrowth::is_free(Segment edge) {
  ++counts_.edge_checks;
  return world_.is_free(edge, params_.clearance);
}

bool TreeGrowth::is_free(std::span<const Vec2> arc) {
  ++counts_.edge_checks;
  return world_.is_free(arc, params_.clearance);
}

bool TreeGrowth::is_open(Vec2 p, double length) {
  const bool is_open = world_.is_open(p, params_.clearance + length * (1 + 1e-12));
  counts_.edge_checks += is_open;
  return is_open;
}

bool TreeGrowth::edge_is_free(std::uint32_t node, Vec2 p) {
  const TreeNode& from = tree_[node];
  if (cost_.turn_radius <= 0) return is_free(Segment{from.position, p});
  chords_.clear();
  append_edge({from.position, from.heading}, p, cost_.turn_radius, chords_);
  ++counts_.edge_checks;
  return world_.is_free(chords_, params_.clearance + chord_error(cost_.turn_radius));
}

std::uint32_t TreeGrowth::add(std::uint32_t parent, Vec2 p) {
  const std::uint32_t node = tree_.add(parent, p);
  if (arrives(p)) arrived_.push_back(node);
  return node;
}

void TreeGrowth::find_near(Vec2 p, const RrtStarParams& params) {
  double radius = params.search_radius;
  if (params.shrinking) {
    const Box& bounds = world_.bounds();
    radius = std::min(radius, shrinking_radius(bounds.width() * bounds.height(), tree_.size()));
  }
  tree_.near(p, radius, near_);
}

std::uint32_t TreeGrowth::choose_parent(Vec2 p, std::uint32_t nearest) {
  candidates_.clear();
  candidates_.push_back({tree_.cost_via(nearest, p), nearest});
  for (const std::uint32_t node : near_) {
    if (node == nearest || tree_[node].position == p) continue;
    // No cheaper than the edge already known to be free.
    const double known = candidates_.front().cost;
    if (!tree_.may_be_cheaper(node, p, known)) continue;
    const double cost = tree_.cost_via(node, p);
    if (cost < known) candidates_.push_back({cost, node});
  }
  std::make_heap(candidates_.begin(), candidates_.end());
  while (candidates_.front().node != nearest) {
    const std::uint32_t node = candidates_.front().node;
    if (edge_is_free(node, p)) return node;
    std::pop_heap(candidates_.begin(), candidates_.end());
    candidates_.pop_back();
  }
  return nearest;
}

void TreeGrowth::rewire(std::uint32_t node) {
  const Vec2 p = tree_[node].position;
  for (const std::uint32_t other : near_) {
    const Vec2 q = tree_[other].position;
    if (cost_.turn_radius > 0 && !tree_.is_leaf(other)) continue;
    // Costs grow along every path, so an ancestor of this node is never cheaper through it.
    const double known = tree_[other].cost;
    if (q != p && tree_.may_be_cheaper(node, q, known) && tree_.cost_via(node, q) < known &&
        edge_is_free(node, q)) {
      tree_.reparent(other, node);
    }
  }
}

Plan TreeGrowth::finish() {
  Plan plan;
  const auto cheaper = [&](std::uint32_t a, std::uint32_t b) {
    return tree_[a].cost < tree_[b].cost;
  };
  std::uint32_t last = 0;
  if (solved()) {
    plan.status = Status::solved;
    last = *std::min_element(arrived_.begin(), arrived_.end(), cheaper);
  } else {
    plan.status = ended_.value_or(Status::stopped);
    if (is_finite(goal_)) last = tree_.nearest(goal_);
  }
  plan.counts = counts_;
  plan.tree = tree_.take_nodes();
  plan.path = path_to(plan.tree, last);
  return plan;
}

Vec2 steer(Vec2 from, Vec2 to, double step) {
  const double length = distance(from, to);
  return length <= step ? to : from + (step / length) * (to - from);
}

}  // namespace microswarm::planning
