// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/aggregation.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/error.hpp"

namespace microswarm {
namespace {

constexpr std::uint32_t nowhere = ~0u;
constexpr double golden_angle = 2.399963229728653;

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

std::optional<Vec2> Gatherer::next(const Robots& robots) {
  look(robots);
  if (robots.size() == 0 || mean_way_ < params_.sigma) return std::nullopt;
  if (guard()) {
    leader_ = *driven_;
  } else {
    leader_ = params_.method == Aggregation::heuristic ? heuristic() : divide_and_conquer();
  }
  const Vec2 p = robots.position(leader_);
  held_ = leader_ == last_leader_ && p == last_place_ ? held_ + 1 : 0;
  last_leader_ = leader_;
  last_place_ = p;
  waypoint_ = waypoint_of(leader_, p);
  const Vec2 way = waypoint_ - p;
  const double length = norm(way);
  const Vec2 move = length > 0 ? (params_.step / length) * way : Vec2{params_.step, 0};
  return held_ > 1 ? rotated(move, held_ * golden_angle) : move;  // off a corner that holds it
}

void Gatherer::look(const Robots& robots) {
  const std::size_t n = robots.size();
  nodes_.resize(n);
  ways_.resize(n);
  heading_for_.resize(n, nowhere);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 p = robots.position(i);
    nodes_[i] = ground_->tree.nearest(p);
    ways_[i] = routes_->length[nodes_[i]] + distance(p, ground_->tree.nodes[nodes_[i]]);
    sum += ways_[i];
  }
  mean_way_ = n > 0 ? sum / static_cast<double>(n) : 0;
}

std::size_t Gatherer::farthest() const {
  return static_cast<std::size_t>(std::max_element(ways_.begin(), ways_.end()) - ways_.begin());
}

// Alg 3: the farthest robot leads until it is there.
std::size_t Gatherer::heuristic() const {
  const bool on_its_way = leader_ < ways_.size() && ways_[leader_] >= 2 * params_.step;
  return on_its_way ? leader_ : farthest();
}

// Alg 5: the region and the branch stay until no robot is left in them (lines 3, 5).
std::size_t Gatherer::divide_and_conquer() {
  const MapSegmentation& map = ground_->segmentation;
  std::uint32_t farthest_region = 0;
  bool region_holds = false;
  bool branch_holds = false;
  for (const std::uint32_t node : nodes_) {
    farthest_region = std::max(farthest_region, map.region[node]);
    const bool in_region = map.region[node] == region_;
    region_holds = region_holds || in_region;
    branch_holds = branch_holds || (in_region && map.branch[node] == branch_);
  }
  if (leads_ && !arrived_in_next()) return leader_;
  leads_ = false;
  if (!region_holds || region_ == 0) region_ = farthest_region;           // line 2
  if (region_ == 0) return heuristic();                                   // all are on the last way
  if (!region_holds || !branch_holds) branch_ = richest_branch(region_);  // line 4
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {  // line 6
    if (map.region[nodes_[i]] != region_ || map.branch[nodes_[i]] != branch_) continue;
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

// q_next of line 8: the next region's junction, but no farther than the channel is wide there, so
// that the robot is not drawn out again by what the next leader does beside its way.
double Gatherer::target_of(std::uint32_t region) const {
  const Region& from = ground_->segmentation.regions[region];
  const Region& next = ground_->segmentation.regions[from.next];
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
    v = std::max(0.0, v) + std::pow(params_.discount, way_to_gate(i) / params_.discount_length);
  }
  return static_cast<std::uint32_t>(std::max_element(value.begin(), value.end()) - value.begin());
}

double Gatherer::way_to_gate(std::size_t robot) const {
  const Region& region = ground_->segmentation.regions[ground_->segmentation.region[nodes_[robot]]];
  return std::max(0.0, ways_[robot] - routes_->length[region.node]);
}

// True while it drives a robot home.
bool Gatherer::guard() {
  if (mean_way_ < best_mean_ - 1e-9) {
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
  GatherResult result;
  for (;; ++result.steps) {
    const std::optional<Vec2> move = gatherer.next(robots);
    if (!move) {
      result.status = Status::solved;
    } else if (stop()) {
      result.status = Status::stopped;
    } else if (result.steps < most_steps) {
      stepper.step(robots, *move, ContactRule::stop);
      continue;
    }
    result.mean_way = gatherer.mean_way();
    result.guard_count = gatherer.guard_count();
    return result;
  }
}

}  // namespace microswarm
