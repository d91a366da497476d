// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/aggregation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "microswarm/core/error.hpp"

namespace microswarm {
namespace {

constexpr std::uint32_t nowhere = ~0u;
constexpr double golden_angle = 2.399963229728653;

/// Rounded to 2^-20: sums are exact, so that they do not depend on the order of the robots.
double on_lattice(double v) {
  constexpr double shift = 0x1.8p32;
  return (v + shift) - shift;
}

}  // namespace

AggregationMap::AggregationMap(Map m, Vec2 goal, const AggregationParams& params, Rng& rng)
    : map(std::move(m)), tree(obstacle_weighted_rrt(map, goal, params.tree, rng)) {
  if (tree.status == Status::goal_blocked) throw InputError("goal is not free");
  if (tree.status != Status::solved)
    throw InputError("the tree has " + std::to_string(tree.nodes.size()) + " nodes after " +
                     std::to_string(params.tree.max_iterations) + " samples, " +
                     std::to_string(params.tree.nodes) + " were asked for");
  segmentation = segment_map(map, tree, params.segmentation);
}

Gatherer::Gatherer(const AggregationMap& ground, const AggregationParams& params)
    : ground_(&ground),
      params_(params),
      routes_(params.obstacle_weighted ? &ground.tree.weighted : &ground.tree.plain),
      longest_(*std::max_element(routes_->length.begin(), routes_->length.end())),
      best_mean_(std::numeric_limits<double>::infinity()),
      patience_(params.patience * std::max(longest_ / params.step, 1.0)) {}

std::optional<Vec2> Gatherer::next(const Robots& robots, std::span<const std::uint32_t> counts) {
  look(robots, counts);
  if (robots.size() == 0 || mean_way_ < params_.sigma) return std::nullopt;
  if (guard()) {
    leader_ = *driven_;
  } else {
    leader_ = by_regions() ? divide_and_conquer() : heuristic();
  }
  const Vec2 p = robots.position(leader_);
  if (leader_ != last_leader_) heading_for_[leader_] = nowhere;
  held_ = leader_ == last_leader_ && p == last_place_ ? held_ + 1 : 0;
  last_leader_ = leader_;
  last_place_ = p;
  waypoint_ = waypoint_of(leader_, p);
  const Vec2 way = waypoint_ - p;
  const double length = norm(way);
  const Vec2 move = length > 0 ? (params_.step / length) * way : Vec2{params_.step, 0};
  return held_ > 1 ? rotated(move, held_ * golden_angle) : move;  // off a corner that holds it
}

// Not any more when that has been caught in a livelock again and again.
bool Gatherer::by_regions() const {
  constexpr int most_livelocks = 3;
  return params_.method != Aggregation::heuristic && guard_count_ < most_livelocks;
}

void Gatherer::look(const Robots& robots, std::span<const std::uint32_t> counts) {
  const std::size_t n = robots.size();
  counts_.assign(counts.begin(), counts.end());
  if (seen_x_.size() != n) {
    sum_ways_ = 0;
    seen_x_.assign(n, std::numeric_limits<float>::quiet_NaN());
    seen_y_.resize(n);
    nodes_.resize(n);
    ways_.assign(n, 0);
    heading_for_.resize(n, nowhere);
    robots_ = counts.empty() ? static_cast<double>(n)
                             : std::accumulate(counts.begin(), counts.end(), 0.0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (robots.x[i] == seen_x_[i] && robots.y[i] == seen_y_[i]) continue;
    seen_x_[i] = robots.x[i];
    seen_y_[i] = robots.y[i];
    const Vec2 p = robots.position(i);
    nodes_[i] = ground_->tree.nearest(p);
    const double before = ways_[i];
    ways_[i] = routes_->length[nodes_[i]] + distance(p, ground_->tree.nodes[nodes_[i]]);
    ways_[i] = on_lattice(ways_[i]);
    sum_ways_ += count_of(i) * (ways_[i] - before);
  }
  mean_way_ = n > 0 ? sum_ways_ / robots_ : 0;
}

void Gatherer::joined(std::span<const std::uint32_t> new_places) {
  if (new_places.size() != seen_x_.size()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < new_places.size(); ++i) {
    if (new_places[i] != kept) {
      const std::size_t to = new_places[i];
      sum_ways_ += count_of(i) * (ways_[to] - ways_[i]);
      if (i == leader_) heading_for_[to] = heading_for_[i];
      continue;
    }
    seen_x_[kept] = seen_x_[i];
    seen_y_[kept] = seen_y_[i];
    nodes_[kept] = nodes_[i];
    ways_[kept] = ways_[i];
    heading_for_[kept] = heading_for_[i];
    ++kept;
  }
  for (auto* all : {&seen_x_, &seen_y_}) all->resize(kept);
  for (auto* all : {&nodes_, &heading_for_}) all->resize(kept);
  ways_.resize(kept);
  for (std::size_t* robot : {&leader_, &last_leader_})
    if (*robot < new_places.size()) *robot = new_places[*robot];
  if (driven_) driven_ = new_places[*driven_];
}

std::size_t Gatherer::farthest() const {
  return static_cast<std::size_t>(std::max_element(ways_.begin(), ways_.end()) - ways_.begin());
}

// Alg 3: the farthest robot leads until it is there.
std::size_t Gatherer::heuristic() const {
  const bool on_its_way = leader_ < ways_.size() && ways_[leader_] >= 2 * params_.step;
  return on_its_way ? leader_ : farthest();
}

// Alg 5: the branch stays until no robot is left in it (line 5).
std::size_t Gatherer::divide_and_conquer() {
  const MapSegmentation& map = ground_->segmentation;
  if (leads_ && !arrived_in_next()) return leader_;
  leads_ = false;
  const std::uint32_t before = region_;
  region_ = next_region();               // lines 2, 3
  if (region_ == 0) return heuristic();  // all are on the last way
  const auto in_branch = [&](std::uint32_t node) {
    return map.region[node] == region_ && map.branch[node] == branch_;
  };
  if (region_ != before || std::none_of(nodes_.begin(), nodes_.end(), in_branch))
    branch_ = richest_branch(region_);  // line 4
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {  // line 6
    if (!in_branch(nodes_[i])) continue;
    const double way = way_to_gate(i);
    if (way < least) {
      least = way;
      nearest = i;
    }
  }
  leads_ = true;
  target_way_ = target_of(region_);
  return nearest;
}

// The map shrinks by a region when that is empty (Eq 7): robots that are pushed back behind it wait
// for the next round, which begins when only the goal's region is left. The same region stays until
// it is empty.
std::uint32_t Gatherer::next_region() const {
  std::uint32_t in_round = 0;
  std::uint32_t of_all = 0;
  for (const std::uint32_t node : nodes_) {
    const std::uint32_t region = ground_->segmentation.region[node];
    of_all = std::max(of_all, region);
    if (region <= region_) in_round = std::max(in_round, region);
  }
  return in_round > 0 ? in_round : of_all;
}

// q_next of line 8: the next region's junction. In the goal's region one width of the channel will
// do, since that is closed: who is in stays in.
double Gatherer::target_of(std::uint32_t region) const {
  const Region& from = ground_->segmentation.regions[region];
  const Region& next = ground_->segmentation.regions[from.next];
  if (from.next != 0) return routes_->length[next.node];
  const double width = 2 * ground_->map.clearance(ground_->tree.nodes[from.gate]);
  return std::max(routes_->length[next.node], routes_->length[from.gate] - width);
}

bool Gatherer::arrived_in_next() const { return ways_[leader_] <= target_way_ + params_.step; }

// Eq 6 [gather]
std::uint32_t Gatherer::richest_branch(std::uint32_t region) const {
  const MapSegmentation& map = ground_->segmentation;
  std::vector<double> value(std::max(1u, map.regions[region].branches), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (map.region[nodes_[i]] != region) continue;
    double& v = value[map.branch[nodes_[i]]];
    const double share = std::pow(params_.discount, way_to_gate(i) / params_.discount_length);
    v = std::max(0.0, v) + count_of(i) * on_lattice(share);
  }
  return static_cast<std::uint32_t>(std::max_element(value.begin(), value.end()) - value.begin());
}

double Gatherer::way_to_gate(std::size_t robot) const {
  const Region& region = ground_->segmentation.regions[ground_->segmentation.region[nodes_[robot]]];
  return std::max(0.0, ways_[robot] - routes_->length[region.node]);
}

// True while it drives a robot home. Progress is counted in shares of σ, so that there is only so
// much of it; each time it waits twice as long.
bool Gatherer::guard() {
  constexpr double least_progress = 0.01;
  if (mean_way_ <= best_mean_ - least_progress * params_.sigma) {
    best_mean_ = mean_way_;
    since_best_ = 0;
  }
  if (driven_ && ways_[*driven_] < params_.sigma) driven_.reset();
  if (!driven_ && ++since_best_ > patience_) {
    driven_ = farthest();
    ++guard_count_;
    since_best_ = 0;
    patience_ *= 2;
    best_mean_ = mean_way_;
  }
  return driven_.has_value();
}

// Via the nearest vertex, then from vertex to vertex as far as they are seen, until a whole step is
// ahead. A robot keeps to the way it has begun, else it would waver between branches of the tree.
Vec2 Gatherer::waypoint_of(std::size_t robot, Vec2 p) {
  constexpr int most_nodes = 16;
  const ObstacleWeightedRrt& tree = ground_->tree;
  const auto sees = [&](std::uint32_t node) {
    return ground_->map.is_free(Segment{p, tree.nodes[node]}, 0);
  };
  std::uint32_t& node = heading_for_[robot];
  if (node == nowhere || held_ > 0 || !sees(node))
    node = tree.nearest_visible(ground_->map, p).value_or(tree.nearest(p));
  for (int k = 0; k < most_nodes; ++k) {
    const std::uint32_t next = routes_->next[node];
    if (next == node || distance(p, tree.nodes[node]) >= params_.step || !sees(next)) break;
    node = next;
  }
  return tree.nodes[node];
}

GatherResult gather(const RobotStepper& stepper, Gatherer& gatherer, Robots& robots, int most_steps,
                    const Stop& stop) {
  constexpr int steps_between_joins = 16;
  GatherResult result;
  Crowd crowd(robots);
  for (;; ++result.steps) {
    if (result.steps % steps_between_joins == 0) {
      if (const auto new_places = crowd.join(); !new_places.empty()) gatherer.joined(new_places);
    }
    const std::optional<Vec2> move = gatherer.next(crowd.places(), crowd.counts());
    if (!move) {
      result.status = Status::solved;
    } else if (stop()) {
      result.status = Status::stopped;
    } else if (result.steps < most_steps) {
      stepper.step(crowd.places(), *move, ContactRule::stop);
      continue;
    }
    result.mean_way = gatherer.mean_way();
    result.guard_count = gatherer.guard_count();
    robots = crowd.robots();
    return result;
  }
}

}  // namespace microswarm
