// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/turn_edge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::planning {
namespace {

constexpr double chord_angle = pi / 18;
constexpr double turn_rounding = 1e-9;  // [rad]

Vec2 left_normal(double heading) { return perpendicular(unit_vector(heading)); }

/// Edge that turns to one side; infinitely long if `to` lies inside that turning circle.
TurnEdge turn_to_side(const Pose2& from, Vec2 to, double radius, double side) {
  const Vec2 centre = from.position + side * radius * left_normal(from.heading);
  const Vec2 off = to - centre;
  const double far = norm(off);
  if (far < radius * (1 - turn_rounding))
    return {.length = std::numeric_limits<double>::infinity()};
  const double touching = heading_along(off) - side * maths::acos(std::min(1.0, radius / far));
  double turn = wrap(side * (touching - heading_along(from.position - centre)));
  if (turn < -turn_rounding) turn += 2 * pi;
  turn = std::max(0.0, turn);
  const double straight = std::sqrt(std::max(0.0, far * far - radius * radius));
  return {side * turn, straight, wrap(from.heading + side * turn), radius * turn + straight};
}

}  // namespace

TurnEdge turn_edge(const Pose2& from, Vec2 to, double radius) {
  const TurnEdge left = turn_to_side(from, to, radius, 1);
  const TurnEdge right = turn_to_side(from, to, radius, -1);
  return right.length < left.length ? right : left;
}

void append_chords(const Pose2& from, const TurnEdge& edge, double radius, double most,
                   std::vector<Vec2>& out) {
  const auto append = [&](Vec2 p) {
    if (out.empty() || !(out.back() == p)) out.push_back(p);
  };
  append(from.position);
  const double side = edge.turn < 0 ? -1 : 1;
  const double turn = std::min(std::abs(edge.turn), most / radius);
  const Vec2 centre = from.position + side * radius * left_normal(from.heading);
  const int chords = static_cast<int>(std::ceil(turn / chord_angle));
  for (int k = 1; k <= chords; ++k)
    append(centre - side * radius * left_normal(from.heading + side * turn * k / chords));
  const double straight = std::min(edge.straight, most - radius * std::abs(edge.turn));
  if (straight > 0) append(out.back() + straight * unit_vector(edge.heading));
}

void append_edge(const Pose2& from, Vec2 to, double radius, std::vector<Vec2>& out) {
  const TurnEdge edge = turn_edge(from, to, radius);
  append_chords(from, edge, radius, edge.length, out);
  if (edge.length > 0) out.back() = to;  // exact, apart from rounding
}

double chord_error(double radius) { return radius * (1 - maths::cos(0.5 * chord_angle)); }

}  // namespace microswarm::planning
