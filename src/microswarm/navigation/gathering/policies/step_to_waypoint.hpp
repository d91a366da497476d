// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm::navigation {

/// Moves that lead one robot at a time to waypoints, and off a corner that holds it.
class StepToWaypoint {
 public:
  /// `step` [µm] is the length of a move.
  explicit StepToWaypoint(double step) : step_(step) {}

  /// Takes the robot that leads and its position.
  void observe(std::size_t robot, Vec2 p);
  /// Whether the last move of the same robot did not move it.
  bool is_held() const { return held_ > 0; }
  /// Next move [µm], at most a step; a turned one after two moves that did not move the robot.
  Vec2 to(Vec2 waypoint);
  /// The robot has another index, as positions were merged.
  void rename(std::size_t robot) { robot_ = robot; }

  std::size_t robot() const { return robot_; }
  /// The point that the last move leads to.
  Vec2 waypoint() const { return waypoint_; }

 private:
  double step_;
  std::size_t robot_ = ~std::size_t{0};
  Vec2 position_;
  int held_ = 0;  ///< moves for which the robot has not moved
  Vec2 waypoint_;
};

}  // namespace microswarm::navigation
