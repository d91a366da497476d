// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "microswarm/navigation/gathering/policies/cell_graph.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm::navigation {

/// Effect of one input on all robots of a gathering: until they meet a wall, or by the cell rule.
class CommonInput {
 public:
  /// Robots move by the rule "stop". The stepper must outlive it.
  CommonInput(const RobotStepper& stepper) : stepper_(&stepper) {}  // NOLINT: the usual one
  /// Robots move to neighbouring cells. The graph must outlive it.
  explicit CommonInput(const CellGraph& cells) : cells_(&cells) {}

  /// Moves every robot by `move` [µm]; by the cell rule, in the direction of its signs.
  void step(Robots& robots, Vec2 move) const;

 private:
  const RobotStepper* stepper_ = nullptr;
  const CellGraph* cells_ = nullptr;
};

/// Robots at these cells, for the cell rule.
Robots robots_at(const CellGraph& cells, std::span<const std::uint32_t> nodes);

}  // namespace microswarm::navigation
