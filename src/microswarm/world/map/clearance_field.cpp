// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/clearance_field.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/world/map/field_painter.hpp"

namespace microswarm {
namespace {

constexpr double cells_by_default = 260e3;
constexpr double max_field_cells = 4 * 1024 * 1024;

}  // namespace

ClearanceField::ClearanceField(const Box& bounds, const BodySet& bodies, double cell) {
  const double area = bounds.width() * bounds.height();
  const double longest = std::max(bounds.width(), bounds.height());
  if (cell <= 0) cell = std::max(std::sqrt(area / cells_by_default), longest / cells_by_default);
  cell_ = std::max({cell, std::sqrt(area / max_field_cells), longest / max_field_cells});
  per_cell_ = 1 / cell_;
  origin_ = bounds.lo - Vec2{cell_, cell_};
  columns_ = static_cast<int>((bounds.hi.x - origin_.x) * per_cell_);
  rows_ = static_cast<int>((bounds.hi.y - origin_.y) * per_cell_);
  last_column_ = columns_ + 1;
  last_row_ = rows_ + 1;
  stride_ = static_cast<std::size_t>(columns_) + 2;
  lower_.assign(stride_ * (static_cast<std::size_t>(rows_) + 2), lower_[0]);
  nearest_.resize(lower_.size());
  FieldPainter painter(bounds, bodies, *this);
  painter.paint();
  double largest = 0;
  for (const float l : lower_) {
    if (std::isfinite(l)) largest = std::max(largest, std::abs(static_cast<double>(l)));
  }
  const double of_floats = 4 * static_cast<double>(std::numeric_limits<float>::epsilon());
  spread_ = std::sqrt(2.0) * cell_ * (1 + 1e-6) + 4 * painter.rounding() + of_floats * largest;
  doubt_ = 0.5 * spread_ * (1 + 1e-3);
}

/// Same bits as `distance`. The three cases are unpredictable, so all are computed.
double ClearanceField::distance_to(Vec2 p, const Wall& wall) {
  const Segment& s = wall.core;
  const Vec2 along = s.b - s.a;
  const Vec2 to_p = p - s.a;
  const double t = dot(to_p, along);
  const double length2 = squared_norm(along);
  const double area = cross(along, to_p);
  const double cases[] = {area * area / length2, squared_norm(p - s.b), squared_norm(to_p)};
  return std::sqrt(cases[t <= 0 ? 2 : t >= length2 ? 1 : 0]) - wall.radius;
}

double ClearanceField::wall_distance(Vec2 p) const {
  if (walls_.empty()) return infinity;
  const Nearest nearest = nearest_[cell_at(p)];
  if (nearest.first < is_list) {
    const double first = distance_to(p, walls_[nearest.first]);
    const double second = distance_to(p, walls_[nearest.second]);
    return std::max(0.0, std::min(first, second));
  }
  double least = infinity;
  for (const std::uint32_t* entry = &lists_[nearest.second];; ++entry) {
    least = std::min(least, distance_to(p, walls_[*entry / 2]));
    if (*entry % 2 == 1) return std::max(0.0, least);
  }
}

}  // namespace microswarm
