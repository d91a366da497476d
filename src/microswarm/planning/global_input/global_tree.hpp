// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/core/status.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm {

/// At most so many robots are planned for under one input.
inline constexpr std::size_t max_global_robots = 64;

/// The inputs that all robots get alike: `directions` moves of `robostep` µm, evenly spaced from
/// the x axis on, axis directions exact. Alg 2, lines 3–4 [global].
std::vector<PointF> input_moves(int directions, double robostep);
/// The stepper that makes such moves in one go. Planners under one input move robots by its
/// `moved`, and only so do their edges come out to the bits.
RobotStepper input_stepper(const Map& map, double robostep);

/// Tree over the configurations of n robots under one input: flat arrays, one entry a node. Node 0
/// is the start and its own parent. A node is where `input_stepper` moves its parent's robots by
/// its input.
struct GlobalTree {
  std::size_t robots = 0;
  Vec2 origin;  ///< of the configurations, the middle of the map
  double robostep = 0;
  ContactRule contact = ContactRule::slide;
  double separation = 0;              ///< [µm] that robots keep from each other; 0: none
  std::vector<PointF> moves;          ///< the inputs by their index
  std::vector<float> configurations;  ///< [µm] x, y of robot 0, of robot 1 …, 2n a node
  std::vector<std::uint32_t> parents;
  std::vector<std::uint8_t> inputs;  ///< index of the move from the parent; the root's is 0

  std::size_t size() const { return parents.size(); }
  std::span<const float> configuration(std::uint32_t node) const {
    return {configurations.data() + 2 * robots * node, 2 * robots};
  }
  /// Place of a robot in the map's coordinates.
  Vec2 position(std::uint32_t node, std::size_t robot) const {
    const float* p = configurations.data() + 2 * (robots * node + robot);
    return origin + Vec2{static_cast<double>(p[0]), static_cast<double>(p[1])};
  }
  std::vector<Vec2> positions(std::uint32_t node) const;
  void add(std::span<const float> configuration, std::uint32_t parent, std::uint8_t input);
  void reserve(std::size_t nodes);
  /// Bytes of memory in use.
  std::size_t bytes() const;
};

/// Node of a tree that is nearest to goals, one a robot.
struct GoalAnswer {
  Status status = Status::node_limit;  ///< solved, or node_limit: no node is within the tolerance
  std::uint32_t node = 0;
  double worst = 0;  ///< [µm] distance of the robot that is farthest from its goal
};

/// Asks a grown tree: the node whose worst robot is nearest to its goal, the first of equals. A
/// goal is met when every robot is within `tolerance` [µm] of its own. Throws InputError when there
/// are not as many goals as robots.
GoalAnswer ask(const GlobalTree& tree, std::span<const Vec2> goals, double tolerance);

/// Inputs that bring robots to their goals, and where they get by each.
struct GlobalPlan {
  Status status = Status::no_path;
  std::vector<Vec2> inputs;                       ///< moves [µm]
  std::vector<std::vector<Vec2>> configurations;  ///< before the first input, and after each
  double worst = 0;  ///< [µm] distance of the worst robot from its goal at the end
};

/// Way from the root to the answer's node.
GlobalPlan plan_to(const GlobalTree& tree, const GoalAnswer& answer);

/// Throws InputError when robots are none or too many, or goals are given but not as many.
void check_robots(std::span<const Vec2> starts, std::span<const Vec2> goals);

}  // namespace microswarm
