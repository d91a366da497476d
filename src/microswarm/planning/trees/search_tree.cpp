// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/search_tree.hpp"

#include <cassert>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/planning/trees/turn_edge.hpp"

namespace microswarm::planning {

double PathCost::turned_edge(const TreeNode& node, Vec2 p) const {
  const TurnEdge edge = turn_edge({node.position, node.heading}, p, turn_radius);
  return per_length * edge.length + per_turn * std::abs(edge.turn);
}

double PathCost::heading_at_end(const TreeNode& node, Vec2 p) const {
  return turn_radius > 0 ? turn_edge({node.position, node.heading}, p, turn_radius).heading
                         : heading_along(p - node.position);
}

double PathCost::turn(const TreeNode& node, Vec2 p) {
  return turn_between(node.heading, heading_along(p - node.position));
}

SearchTree::SearchTree(const Box& bounds, Pose2 root, PathCost cost)
    : cost_(cost), nodes_{{root.position, root.heading, 0, 0}}, links_(1), points_(bounds) {
  points_.add(root.position);
}

void SearchTree::near(Vec2 p, double radius, std::vector<std::uint32_t>& out) const {
  out.clear();
  points_.within(p, radius, out);
}

std::uint32_t SearchTree::add(std::uint32_t parent, Vec2 p) {
  assert(p != nodes_[parent].position);
  const std::uint32_t node = size();
  const TreeNode& from = nodes_[parent];
  const double heading = cost_.heading_at_end(from, p);
  nodes_.push_back({p, heading, from.cost + cost_.edge(from, p, heading), parent});
  links_.emplace_back();
  link(node, parent);
  points_.add(p);
  return node;
}

void SearchTree::reparent(std::uint32_t node, std::uint32_t parent) {
  assert(node != 0 && !is_below(parent, node));
  unlink(node);
  link(node, parent);
  TreeNode& moved = nodes_[node];
  moved.parent = parent;
  const TreeNode& from = nodes_[parent];
  moved.heading = cost_.heading_at_end(from, moved.position);
  moved.cost = from.cost + cost_.edge(from, moved.position, moved.heading);
  recost_below(node);
}

void SearchTree::link(std::uint32_t node, std::uint32_t parent) {
  const std::uint32_t next = links_[parent].first_child;
  links_[node].next = next;
  links_[node].previous = 0;
  if (next != 0) links_[next].previous = node;
  links_[parent].first_child = node;
}

void SearchTree::unlink(std::uint32_t node) {
  const auto [_, next, previous] = links_[node];
  if (next != 0) links_[next].previous = previous;
  if (previous != 0) {
    links_[previous].next = next;
  } else {
    links_[nodes_[node].parent].first_child = next;
  }
}

void SearchTree::recost_below(std::uint32_t node) {
  std::uint32_t at = links_[node].first_child;
  while (at != 0) {
    nodes_[at].cost = cost_via(nodes_[at].parent, nodes_[at].position);
    if (links_[at].first_child != 0) {
      at = links_[at].first_child;
      continue;
    }
    while (at != node && links_[at].next == 0) at = nodes_[at].parent;
    if (at == node) return;
    at = links_[at].next;
  }
}

bool SearchTree::is_below(std::uint32_t node, std::uint32_t ancestor) const {
  while (node != 0 && node != ancestor) node = nodes_[node].parent;
  return node == ancestor;
}

}  // namespace microswarm::planning
