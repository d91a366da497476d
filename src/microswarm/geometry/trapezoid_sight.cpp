// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/trapezoid_sight.hpp"

#include "microswarm/geometry/distance.hpp"

namespace microswarm {

void TrapezoidLook::begin(const Trapezoids& cells, Vec2 from, Vec2 to, double keep) {
  cells_ = &cells;
  rays_ = {.centre = from, .keep = keep};
  to_ = to;
  left_ = 0;
  beyond_.clear();
  const auto put_off = [&](std::uint32_t cell, bool rightwards) {
    beyond_.push_back({{cell}, rightwards, 0});
  };
  if (const std::uint32_t number = cells.point_at(from); number != Trapezoids::none) {
    const auto [first, last] = cells.cells_right_of(number);
    for (std::uint32_t cell = first; cell < last; ++cell) put_off(cell, true);
    for (const std::uint32_t cell : cells.cells_left_of(number)) put_off(cell, false);
    return;
  }
  const std::uint32_t here = cells.cell_at(from);
  put_off(here, true);
  put_off(here, false);
}

/// Space beyond the wall at x is visible through the cone, and a path passes it at most `keep`
/// away. The shortest path to the goal over the wall is straight, or reflected in it.
double TrapezoidLook::length_over(const Cone& cone, bool rightwards) const {
  const Trapezoids::Cell& cell = cells_->cells()[cone.cell];
  const Vec2 s = rays_.centre;
  const double x = cells_->points()[rightwards ? cell.left : cell.right].x;
  const double run = x - s.x;
  const double back = to_.x - x;  // from the wall to the goal
  const double sum = std::abs(run) + std::abs(back);
  double y = sum > 0 ? s.y + (to_.y - s.y) * (std::abs(run) / sum) : s.y;
  // A point straight above or below is no limit: where it is seen on the wall is not known.
  const auto limits = [&](std::uint32_t point) {
    return point != Trapezoids::none && cells_->points()[point].x != s.x;
  };
  const auto at_wall = [&](std::uint32_t point) {
    const Vec2 p = cells_->points()[point];
    return s.y + (p.y - s.y) * (run / (p.x - s.x));
  };
  if (limits(cone.lower)) y = std::max(y, at_wall(cone.lower));
  if (limits(cone.upper)) y = std::min(y, at_wall(cone.upper));
  const Vec2 q{x, y};
  constexpr double less = 1 - 1e-12;  // rounding makes it longer by no more than this share
  return less * (distance(s, q) + distance(q, to_)) - 2 * rays_.keep;
}

}  // namespace microswarm
