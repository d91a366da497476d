// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/global_separation.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::planning {
namespace {

constexpr int max_halvings = 6;
constexpr float rigid_share = 1e-4f;  // of a move: a pair that changes by less moves as one

PointF minus(PointF a, PointF b) { return {a.x - b.x, a.y - b.y}; }
float norm(PointF v) { return std::sqrt(v.x * v.x + v.y * v.y); }

/// Minimum norm on the segment from `a` to `b`.
float min_norm(PointF a, PointF b) {
  const PointF v = minus(b, a);
  const float square = v.x * v.x + v.y * v.y;
  const float share = square > 0 ? std::clamp(-(a.x * v.x + a.y * v.y) / square, 0.0f, 1.0f) : 0.0f;
  return norm({a.x + share * v.x, a.y + share * v.y});
}

}  // namespace

bool GlobalSeparation::holds(std::span<const PointF> robots) const {
  if (!is_on()) return true;
  for (std::size_t i = 0; i < robots.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (norm(minus(robots[i], robots[j])) < min_distance_) return false;
  return true;
}

bool GlobalSeparation::holds(std::span<const PointF> from, std::span<const PointF> to,
                             PointF move) const {
  if (!is_on()) return true;
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!holds({from[i], from[j]}, {to[i], to[j]}, move)) return false;
  return true;
}

bool GlobalSeparation::holds(const Pair& from, const Pair& to, PointF move) const {
  const auto is_straight = [&](PointF p, PointF q) {
    return rule_ == ContactRule::reject || (q.x == p.x + move.x && q.y == p.y + move.y) ||
           (q.x == p.x && q.y == p.y);
  };
  const PointF before = minus(from.a, from.b);
  const PointF after = minus(to.a, to.b);
  if (norm(after) < min_distance_) return false;
  if (is_straight(from.a, to.a) && is_straight(from.b, to.b))
    return min_norm(before, after) >= min_distance_;
  return holds_between(from, to, move, 0, from, 1, to, max_halvings);
}

GlobalSeparation::Pair GlobalSeparation::at(const Pair& from, const Pair& to, PointF move,
                                            float share) const {
  if (share == 1) return to;
  const PointF part{share * move.x, share * move.y};
  return {stepper_.moved(from.a, part, rule_), stepper_.moved(from.b, part, rule_)};
}

// If the share grows by h, the distance changes by at most 2 h times the move.
bool GlobalSeparation::holds_between(const Pair& from, const Pair& to, PointF move, float low,
                                     const Pair& at_low, float high, const Pair& at_high,
                                     int halvings) const {
  const PointF before = minus(at_low.a, at_low.b);
  const PointF after = minus(at_high.a, at_high.b);
  const float nearest = std::min(norm(before), norm(after));
  if (nearest < min_distance_) return false;
  const float far = norm(move);
  if ((norm(before) + norm(after)) / 2 - (high - low) * far >= min_distance_) return true;
  if (halvings == 0) return norm(minus(after, before)) <= rigid_share * far;
  const float middle = (low + high) / 2;
  const Pair at_middle = at(from, to, move, middle);
  return holds_between(from, to, move, low, at_low, middle, at_middle, halvings - 1) &&
         holds_between(from, to, move, middle, at_middle, high, at_high, halvings - 1);
}

}  // namespace microswarm::planning
