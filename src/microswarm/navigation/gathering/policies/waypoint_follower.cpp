// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/waypoint_follower.hpp"

namespace microswarm::navigation {
namespace {

constexpr std::uint32_t nowhere = ~0u;

}  // namespace

Vec2 WaypointFollower::move(std::size_t robot, std::size_t count, Vec2 p) {
  if (map_->cells) return map_->next_cell(p) - p;
  node_of_.resize(count, nowhere);
  if (robot != step_to_.robot()) node_of_[robot] = nowhere;
  step_to_.observe(robot, p);
  return step_to_.to(next_waypoint(robot, p));
}

void WaypointFollower::remap(std::span<const std::uint32_t> new_positions) {
  node_of_.resize(new_positions.size(), nowhere);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < new_positions.size(); ++i) {
    const std::size_t to = new_positions[i];
    if (to == kept)
      node_of_[kept++] = node_of_[i];
    else if (i == step_to_.robot())
      node_of_[to] = node_of_[i];
  }
  node_of_.resize(kept);
  if (step_to_.robot() < new_positions.size()) step_to_.rename(new_positions[step_to_.robot()]);
}

// Via the nearest node, then from node to node as far as they are visible, until a whole step is
// ahead. A robot keeps to the node it was led to, else it would waver between branches of the tree.
Vec2 WaypointFollower::next_waypoint(std::size_t robot, Vec2 p) {
  constexpr int max_nodes = 16;
  const planning::ObstacleWeightedRrt& tree = map_->tree;
  const planning::Routes& routes = map_->routes();
  const auto sees = [&](std::uint32_t node) {
    return map_->map.is_free(Segment{p, tree.nodes[node]}, 0);
  };
  std::uint32_t& node = node_of_[robot];
  if (node == nowhere || step_to_.is_held() || !sees(node))
    node = tree.nearest_visible(map_->map, p).value_or(tree.nearest(p));
  for (int k = 0; k < max_nodes; ++k) {
    const std::uint32_t next = routes.next[node];
    if (next == node || distance(p, tree.nodes[node]) >= step_ || !sees(next)) break;
    node = next;
  }
  return tree.nodes[node];
}

}  // namespace microswarm::navigation
