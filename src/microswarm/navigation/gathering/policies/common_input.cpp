// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/common_input.hpp"

namespace microswarm::navigation {

void CommonInput::step(Robots& robots, Vec2 move) const {
  if (stepper_) return stepper_->step(robots, move, ContactRule::stop);
  if (move == Vec2{}) return;
  const std::size_t direction = CellGraph::nearest_direction(move);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const std::uint32_t node = cells_->at(robots.position(i));
    const Vec2 to = (*cells_)[cells_->neighbour(node, direction)] - robots.origin;
    robots.x[i] = static_cast<float>(to.x);
    robots.y[i] = static_cast<float>(to.y);
  }
}

Robots robots_at(const CellGraph& cells, std::span<const std::uint32_t> nodes) {
  Robots robots;
  for (const std::uint32_t node : nodes) {
    robots.x.push_back(static_cast<float>(cells[node].x));
    robots.y.push_back(static_cast<float>(cells[node].y));
  }
  return robots;
}

}  // namespace microswarm::navigation
