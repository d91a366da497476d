// SPDX-License-Identifier: Apache-2.0
#include "bench/naive_robots.hpp"

#include <cmath>

namespace microswarm::bench {
namespace {

constexpr double standoff = 1e-3;  // [µm]

/// Fraction of the move up to the edge, minus the perpendicular standoff; above 1 if the edge is
/// not reached.
double time_to(const Segment& edge, Vec2 p, Vec2 move) {
  const Vec2 along = edge.b - edge.a;
  const double turn = cross(move, along);
  if (turn == 0) return 2;
  const Vec2 to_edge = edge.a - p;
  const double t = cross(to_edge, along) / turn;
  const double position = cross(to_edge, move) / turn;
  if (t < 0 || position < -1e-6 || position > 1 + 1e-6) return 2;
  return t - standoff * norm(along) / std::abs(turn);
}

}  // namespace

NaiveRobots::NaiveRobots(const Map& map, std::vector<Vec2> positions)
    : places_(std::move(positions)) {
  const Box& b = map.bounds();
  const Vec2 corners[] = {b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}};
  for (int i = 0; i < 4; ++i) edges_.push_back({corners[i], corners[(i + 1) % 4]});
  for (const Body& body : map.walls().bodies())
    for_each_edge(std::get<Polygon>(body.shape), [&](Vec2 a, Vec2 c) { edges_.push_back({a, c}); });
}

void NaiveRobots::step(Vec2 move) {
  for (Vec2& p : places_) {
    double first = 2;
    for (const Segment& edge : edges_) first = std::min(first, time_to(edge, p, move));
    p += (first <= 1 ? std::max(0.0, first) : 1.0) * move;
  }
}

}  // namespace microswarm::bench
