// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/point_grid.hpp"

namespace microswarm::planning {

/// Cost of a path, summed over its edges: length and the turn into each edge. The turn into a
/// root's first edge starts at the root's heading. Eq 9 [drrt]; for RRT* the length alone. With a
/// turning radius, a change of a node's heading changes the edges to its children.
struct PathCost {
  double per_length = 1;   ///< λ_l
  double per_turn = 0;     ///< λ_s [µm/rad]
  double turn_radius = 0;  ///< edges are TurnEdges of this radius [µm]; 0: straight, with corners

  /// Cost of the edge from `node` to `p` [µm].
  double edge(const TreeNode& node, Vec2 p) const {
    if (turn_radius > 0) return turned_edge(node, p);
    const double length = per_length * distance(node.position, p);
    return per_turn == 0 ? length : length + per_turn * turn(node, p);
  }
  /// The same [µm], given the heading at `p` on the edge, which saves computing it.
  double edge(const TreeNode& node, Vec2 p, double heading) const {
    if (turn_radius > 0) return turned_edge(node, p);
    const double length = per_length * distance(node.position, p);
    return per_turn == 0 ? length : length + per_turn * turn_between(node.heading, heading);
  }
  /// Cost of a path of straight edges [µm], with the turn out of the start's heading [rad].
  double of(std::span<const Vec2> path, double start_heading) const {
    return per_length * path_length(path) + per_turn * path_turning(path, start_heading);
  }
  /// Heading [rad] at `p` on the edge from `node`.
  double heading_at_end(const TreeNode& node, Vec2 p) const;
  static double turn(const TreeNode& node, Vec2 p);

 private:
  double turned_edge(const TreeNode& node, Vec2 p) const;
};

/// Search tree with exact neighbour queries. Headings and costs of all nodes are consistent after
/// every call: cost(node) = cost(parent) + edge(parent, node), to the bit.
class SearchTree {
 public:
  /// Nodes are expected, but not required, to lie in `bounds`.
  SearchTree(const Box& bounds, Pose2 root, PathCost cost);

  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  const TreeNode& operator[](std::uint32_t node) const { return nodes_[node]; }
  bool is_leaf(std::uint32_t node) const { return links_[node].first_child == 0; }
  std::uint32_t nearest(Vec2 p) const { return points_.nearest(p); }
  /// Replaces `out` by all nodes within `radius` of `p`, ascending.
  void near(Vec2 p, double radius, std::vector<std::uint32_t>& out) const;
  /// Cost from the root to `p` through `node` [µm].
  double cost_via(std::uint32_t node, Vec2 p) const {
    return nodes_[node].cost + cost_.edge(nodes_[node], p);
  }

  /// Whether the cost to `p` through `node` can be less than `known`, which the length of a
  /// straight edge alone may exclude. Turns cost nothing or more, and rounding is monotone, so this
  /// never excludes wrongly.
  bool may_be_cheaper(std::uint32_t node, Vec2 p, double known) const {
    return cost_.turn_radius > 0 ||
           nodes_[node].cost + cost_.per_length * distance(nodes_[node].position, p) < known;
  }

  /// Adds a leaf at `p`, which must differ from its parent's position.
  std::uint32_t add(std::uint32_t parent, Vec2 p);
  /// Moves `node` to another parent, which must not be `node` or below it, and updates the costs of
  /// the subtree of `node`.
  void reparent(std::uint32_t node, std::uint32_t parent);

  std::vector<TreeNode> take_nodes() { return std::move(nodes_); }

 private:
  /// Doubly linked list of a node's children. 0 means none, since the root is no child.
  struct Links {
    std::uint32_t first_child = 0;
    std::uint32_t next = 0;
    std::uint32_t previous = 0;
  };
  void link(std::uint32_t node, std::uint32_t parent);
  void unlink(std::uint32_t node);
  void recost_below(std::uint32_t node);
  bool is_below(std::uint32_t node, std::uint32_t ancestor) const;

  PathCost cost_;
  std::vector<TreeNode> nodes_;
  std::vector<Links> links_;
  PointGrid points_;
};

}  // namespace microswarm::planning
