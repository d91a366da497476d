// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/aggregation_policy.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace microswarm {
namespace {

constexpr std::uint32_t nowhere = ~0u;
constexpr double golden_angle = 2.399963229728653;

}  // namespace

AggregationPolicy::AggregationPolicy(const AggregationMap& map, const AggregationParams& params)
    : map_(&map),
      params_(params),
      routes_(&map.routes()),
      dca_(map, params),
      longest_(*std::max_element(routes_->length.begin(), routes_->length.end())),
      best_mean_(std::numeric_limits<double>::infinity()),
      patience_(params.patience * std::max(longest_ / params.step, 1.0)) {}

std::optional<Vec2> AggregationPolicy::next(const Robots& robots,
                                            std::span<const std::uint32_t> counts) {
  look(robots, counts);
  if (robots.size() == 0 || mean_distance_ < params_.sigma) return std::nullopt;
  const bool breaks = guard();
  const bool by_regions = !breaks && params_.method != Aggregation::heuristic;
  leader_ = by_regions ? dca_.leader(seen_, leader_) : to_the_goal(breaks);
  const Vec2 p = robots.position(leader_);
  if (leader_ != last_leader_) heading_for_[leader_] = nowhere;
  held_ = leader_ == last_leader_ && p == last_place_ ? held_ + 1 : 0;
  last_leader_ = leader_;
  last_place_ = p;
  waypoint_ = waypoint_of(leader_, p);
  const Vec2 way = waypoint_ - p;
  const double length = norm(way);
  if (held_ <= 1) return std::min(1.0, params_.step / std::max(length, 1e-12)) * way;
  const Vec2 move = length > 0 ? (params_.step / length) * way : Vec2{params_.step, 0};
  return rotated(move, held_ * golden_angle);  // off a corner that holds it
}

void AggregationPolicy::look(const Robots& robots, std::span<const std::uint32_t> counts) {
  const std::size_t n = robots.size();
  seen_.counts.assign(counts.begin(), counts.end());
  if (seen_x_.size() != n) {
    sum_distances_ = 0;
    seen_x_.assign(n, std::numeric_limits<float>::quiet_NaN());
    seen_y_.resize(n);
    seen_.nodes.resize(n);
    seen_.ways.assign(n, 0);
    heading_for_.resize(n, nowhere);
    robots_ = counts.empty() ? static_cast<double>(n)
                             : std::accumulate(counts.begin(), counts.end(), 0.0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (robots.x[i] == seen_x_[i] && robots.y[i] == seen_y_[i]) continue;
    seen_x_[i] = robots.x[i];
    seen_y_[i] = robots.y[i];
    const Vec2 p = robots.position(i);
    seen_.nodes[i] = map_->tree.nearest(p);
    const double before = seen_.ways[i];
    seen_.ways[i] = routes_->length[seen_.nodes[i]] + distance(p, map_->tree.nodes[seen_.nodes[i]]);
    seen_.ways[i] = on_lattice(seen_.ways[i]);
    sum_distances_ += seen_.count(i) * (seen_.ways[i] - before);
  }
  mean_distance_ = n > 0 ? sum_distances_ / robots_ : 0;
}

void AggregationPolicy::remap(std::span<const std::uint32_t> new_places) {
  if (new_places.size() != seen_x_.size()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < new_places.size(); ++i) {
    if (new_places[i] != kept) {
      const std::size_t to = new_places[i];
      sum_distances_ += seen_.count(i) * (seen_.ways[to] - seen_.ways[i]);
      if (i == leader_) heading_for_[to] = heading_for_[i];
      continue;
    }
    seen_x_[kept] = seen_x_[i];
    seen_y_[kept] = seen_y_[i];
    seen_.nodes[kept] = seen_.nodes[i];
    seen_.ways[kept] = seen_.ways[i];
    heading_for_[kept] = heading_for_[i];
    ++kept;
  }
  for (auto* all : {&seen_x_, &seen_y_}) all->resize(kept);
  for (auto* all : {&seen_.nodes, &heading_for_}) all->resize(kept);
  seen_.ways.resize(kept);
  for (std::size_t* robot : {&leader_, &last_leader_})
    if (*robot < new_places.size()) *robot = new_places[*robot];
}

std::size_t AggregationPolicy::farthest() const {
  return static_cast<std::size_t>(std::max_element(seen_.ways.begin(), seen_.ways.end()) -
                                  seen_.ways.begin());
}

// Alg 3: the farthest robot leads until it is there; or any, where that has been of no use.
std::size_t AggregationPolicy::to_the_goal(bool any) {
  const bool on_its_way = leader_ < seen_.ways.size() && seen_.ways[leader_] >= 2 * params_.step;
  if (on_its_way) return leader_;
  return any ? some() : farthest();
}

// The first whose way is longer than one chosen at random: the same one however robots are joined.
std::size_t AggregationPolicy::some() {
  std::size_t first = farthest();
  const double way = rng_.uniform(0, seen_.ways[first]);
  for (std::size_t i = 0; i < seen_.ways.size(); ++i)
    if (seen_.ways[i] >= way && seen_.ways[i] < seen_.ways[first]) first = i;
  return first;
}

// True once there is no progress, which is counted in shares of σ.
bool AggregationPolicy::guard() {
  constexpr double min_progress = 0.01;
  if (mean_distance_ <= best_mean_ - min_progress * params_.sigma) {
    best_mean_ = mean_distance_;
    since_best_ = 0;
  }
  if (!breaks_ && ++since_best_ > patience_) breaks_ = true;
  return breaks_;
}

// Via the nearest vertex, then from vertex to vertex as far as they are seen, until a whole step is
// ahead. A robot keeps to the way it has begun, else it would waver between branches of the tree.
Vec2 AggregationPolicy::waypoint_of(std::size_t robot, Vec2 p) {
  constexpr int max_nodes = 16;
  const ObstacleWeightedRrt& tree = map_->tree;
  const auto sees = [&](std::uint32_t node) {
    return map_->map.is_free(Segment{p, tree.nodes[node]}, 0);
  };
  std::uint32_t& node = heading_for_[robot];
  if (node == nowhere || held_ > 0 || !sees(node))
    node = tree.nearest_visible(map_->map, p).value_or(tree.nearest(p));
  for (int k = 0; k < max_nodes; ++k) {
    const std::uint32_t next = routes_->next[node];
    if (next == node || distance(p, tree.nodes[node]) >= params_.step || !sees(next)) break;
    node = next;
  }
  return tree.nodes[node];
}

}  // namespace microswarm
