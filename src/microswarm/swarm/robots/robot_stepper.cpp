// SPDX-License-Identifier: Apache-2.0
#include "microswarm/swarm/robots/robot_stepper.hpp"

#include <algorithm>
#include <array>

#include "microswarm/swarm/robots/contact_moves.hpp"
#include "microswarm/swarm/robots/step_lanes.hpp"

namespace microswarm {

RobotStepper::RobotStepper(const Map& map, double reach) : faces_(map, reach) {}

PointF RobotStepper::relative(Vec2 p) const {
  const Vec2 q = p - faces_.origin();
  return {static_cast<float>(q.x), static_cast<float>(q.y)};
}

Robots RobotStepper::place(std::span<const Vec2> positions) const {
  Robots robots{faces_.origin(), {}, {}};
  for (const Vec2 p : positions) {
    const PointF q = relative(p);
    robots.x.push_back(q.x);
    robots.y.push_back(q.y);
  }
  return robots;
}

PointF RobotStepper::moved(PointF p, PointF move, ContactRule rule) const {
  const auto contact = [this](PointF q, PointF piece) { return faces_.first_contact(q, piece); };
  return ContactMoves(faces_.reach(), faces_.guard(), contact).moved(p, move, rule);
}

void RobotStepper::moved(PointF p, std::span<const PointF> moves, ContactRule rule,
                         std::span<PointF> ends) const {
  constexpr std::size_t at_once = 64;
  std::array<float, at_once> x, y;
  for (std::size_t i = 0; i < moves.size(); i += at_once) {
    const std::span<const PointF> some = moves.subspan(i, std::min(at_once, moves.size() - i));
    std::fill_n(x.begin(), some.size(), p.x);
    std::fill_n(y.begin(), some.size(), p.y);
    step_lanes(faces_, RobotMoves(some), rule, std::span(x).first(some.size()),
               std::span(y).first(some.size()));
    for (std::size_t k = 0; k < some.size(); ++k) ends[i + k] = {x[k], y[k]};
  }
}

void RobotStepper::step(Robots& robots, Vec2 move, ContactRule rule) const {
  const PointF m{static_cast<float>(move.x), static_cast<float>(move.y)};
  step_lanes(faces_, RobotMoves(m), rule, robots.x, robots.y);
}

}  // namespace microswarm
