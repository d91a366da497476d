// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/waypoint_follower.hpp"

#include <algorithm>

namespace microswarm {
namespace {

constexpr std::uint32_t nowhere = ~0u;
constexpr double golden_angle = 2.399963229728653;

}  // namespace

Vec2 WaypointFollower::move(std::size_t robot, std::size_t count, Vec2 p) {
  node_of_.resize(count, nowhere);
  if (robot != leader_) node_of_[robot] = nowhere;
  held_ = robot == leader_ && p == position_ ? held_ + 1 : 0;
  leader_ = robot;
  position_ = p;
  waypoint_ = waypoint_of(robot, p);
  const Vec2 left = waypoint_ - p;
  const double length = norm(left);
  if (held_ <= 1) return std::min(1.0, step_ / std::max(length, 1e-12)) * left;
  const Vec2 move = length > 0 ? (step_ / length) * left : Vec2{step_, 0};
  return rotated(move, held_ * golden_angle);  // off a corner that holds it
}

void WaypointFollower::remap(std::span<const std::uint32_t> new_positions) {
  node_of_.resize(new_positions.size(), nowhere);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < new_positions.size(); ++i) {
    const std::size_t to = new_positions[i];
    if (to == kept)
      node_of_[kept++] = node_of_[i];
    else if (i == leader_)
      node_of_[to] = node_of_[i];
  }
  node_of_.resize(kept);
  if (leader_ < new_positions.size()) leader_ = new_positions[leader_];
}

// Via the nearest node, then from node to node as far as they are visible, until a whole step is
// ahead. A robot keeps to the node it was led to, else it would waver between branches of the tree.
Vec2 WaypointFollower::waypoint_of(std::size_t robot, Vec2 p) {
  constexpr int max_nodes = 16;
  const ObstacleWeightedRrt& tree = map_->tree;
  const Routes& routes = map_->routes();
  const auto sees = [&](std::uint32_t node) {
    return map_->map.is_free(Segment{p, tree.nodes[node]}, 0);
  };
  std::uint32_t& node = node_of_[robot];
  if (node == nowhere || held_ > 0 || !sees(node))
    node = tree.nearest_visible(map_->map, p).value_or(tree.nearest(p));
  for (int k = 0; k < max_nodes; ++k) {
    const std::uint32_t next = routes.next[node];
    if (next == node || distance(p, tree.nodes[node]) >= step_ || !sees(next)) break;
    node = next;
  }
  return tree.nodes[node];
}

}  // namespace microswarm
