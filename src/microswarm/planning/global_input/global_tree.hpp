// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm::planning {

/// Maximum number of robots planned for under one input.
inline constexpr std::size_t max_global_robots = 64;

/// Inputs common to all robots: `directions` moves of `robostep` µm, evenly spaced from the x axis,
/// exact along the axes. Alg 2, lines 3–4 [global].
std::vector<PointF> input_moves(int directions, double robostep);
/// Stepper that makes such moves at once. Planners under one input move robots only with its
/// `moved`, so that their edges are reproduced to the bit.
RobotStepper input_stepper(const Map& map, double robostep);

/// Tree over the configurations of n robots under one input, in flat arrays with one entry per
/// node. Node 0 is the start and its own parent. `input_stepper` moves the parent's robots to a
/// node by the node's input.
struct GlobalTree {
  std::size_t robots = 0;
  Vec2 origin{};  ///< origin of the configurations: the centre of the map
  double robostep = 0;
  ContactRule contact = ContactRule::slide;
  double separation = 0;                ///< minimum distance between robots [µm]; 0: none
  std::vector<PointF> moves{};          ///< inputs by index
  std::vector<float> configurations{};  ///< [µm] x, y of robot 0, of robot 1 …, 2n per node
  std::vector<std::uint32_t> parents{};
  std::vector<std::uint8_t> inputs{};  ///< index of the move from the parent; the root's is 0

  std::size_t size() const { return parents.size(); }
  std::span<const float> configuration(std::uint32_t node) const {
    return {configurations.data() + 2 * robots * node, 2 * robots};
  }
  /// Position of a robot in the map's coordinates.
  Vec2 position(std::uint32_t node, std::size_t robot) const {
    const float* p = configurations.data() + 2 * (robots * node + robot);
    return origin + Vec2{static_cast<double>(p[0]), static_cast<double>(p[1])};
  }
  std::vector<Vec2> positions(std::uint32_t node) const;
  void add(std::span<const float> configuration, std::uint32_t parent, std::uint8_t input);
  void reserve(std::size_t nodes);
  /// Memory in use [bytes].
  std::size_t bytes() const;
};

/// Node of a tree that is nearest to goals, one per robot.
struct GoalAnswer {
  Status status = Status::node_limit;  ///< solved, or node_limit: no node within the tolerance
  std::uint32_t node = 0;
  double worst = 0;  ///< maximum distance of a robot from its goal [µm]
};

/// Queries a grown tree: the node whose worst robot is nearest to its goal, the first among equals.
/// The goals are reached if every robot is within `tolerance` [µm] of its goal. Throws InputError
/// unless there are as many goals as robots.
GoalAnswer ask(const GlobalTree& tree, std::span<const Vec2> goals, double tolerance);

/// Inputs that bring robots to their goals, and the configurations after each.
struct GlobalPlan {
  Status status = Status::no_path;
  std::vector<Vec2> inputs{};                       ///< moves [µm]
  std::vector<std::vector<Vec2>> configurations{};  ///< before the first input, and after each
  double worst = 0;  ///< maximum final distance of a robot from its goal [µm]
};

/// Plan from the root to the answer's node.
GlobalPlan plan_to(const GlobalTree& tree, const GoalAnswer& answer);

/// Throws InputError if there are no or too many robots, or goals are given but not one per robot.
void check_robots(std::span<const Vec2> starts, std::span<const Vec2> goals);

}  // namespace microswarm::planning
