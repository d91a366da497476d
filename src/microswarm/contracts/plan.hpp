// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// Result of a detection circle: Eq 1–3 [drrt].
struct Detection {
  Disc circle{};
  double w1 = 0;   ///< density: covered fraction of the circle, Eq 1
  double w2 = 0;   ///< distribution: proximity of the obstacles to its centre, Eq 2
  double rho = 1;  ///< dynamic adjust factor, Eq 3, floored
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.circle.centre.x, um("x", "Centre of the circle, to the right."));
    visit(self.circle.centre.y, um("y", "Centre of the circle, upwards."));
    visit(self.circle.radius, um("radius", "Radius of the circle."));
    visit(self.w1, plain("w1", "Density, Eq 1 [drrt]."));
    visit(self.w2, plain("w2", "Distribution, Eq 2 [drrt]."));
    visit(self.rho, plain("rho", "Dynamic adjust factor, Eq 3 [drrt]."));
  }
};

/// Node of a search tree. The root is node 0 and its own parent.
struct TreeNode {
  Vec2 position{};
  double heading = 0;  ///< [rad] of the edge from its parent; the root has the start's heading
  double cost = 0;     ///< from the root, in the planner's own measure
  std::uint32_t parent = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.position.x, um("x", "Position to the right."));
    visit(self.position.y, um("y", "Position upwards."));
    visit(self.heading, rad("heading", "Heading of the edge from its parent."));
    visit(self.cost, plain("cost", "Cost from the root, in the planner's measure."));
    visit(self.parent, plain("parent", "Index in its tree, from 0; the root's is 0."));
  }
};

/// Work done by a planner.
struct PlanCounts {
  std::uint64_t iterations = 0;
  std::uint64_t samples = 0;
  std::uint64_t edge_checks = 0;
  PlanCounts& operator+=(const PlanCounts& o) {
    iterations += o.iterations;
    samples += o.samples;
    edge_checks += o.edge_checks;
    return *this;
  }
};

/// Result of a planner. If the status is `solved`, the path runs from the start to a point within
/// the goal tolerance and every edge keeps the clearance. Otherwise it is the best partial path: to
/// the node nearest to the goal, or just the start if there is none.
struct Plan {
  Status status = Status::no_path;
  std::vector<Vec2> path{};             ///< [µm]
  std::optional<double> arc_length{};   ///< [µm] of a path with arcs, which `path` draws by lines
  std::vector<TreeNode> tree{};         ///< empty for planners without one
  std::vector<Detection> detections{};  ///< one per tree node; D-RRT* only
  PlanCounts counts{};
};

/// Length of a path [µm].
double path_length(std::span<const Vec2> path);
/// Length of the path of a plan [µm], arcs as arcs.
inline double path_length(const Plan& plan) {
  return plan.arc_length ? *plan.arc_length : path_length(plan.path);
}
/// Total turning angle [rad]: Σ|Δheading| over its vertices, including the turn from
/// `start_heading` into the first edge.
double path_turning(std::span<const Vec2> path, double start_heading);
/// The same [rad] without the turn at the start.
double path_turning(std::span<const Vec2> path);
/// Path from the root to `node`.
std::vector<Vec2> path_to(std::span<const TreeNode> tree, std::uint32_t node);

}  // namespace microswarm
