// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/common/geodesic_field.hpp"
#include "microswarm/core/heap_entry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace microswarm {
namespace {

constexpr float unreached = std::numeric_limits<float>::infinity();

}  // namespace

GeodesicField::GeodesicField(const Map& map, Vec2 goal, int cells) : goal_(goal) {
  const Box& bounds = map.bounds();
  low_ = bounds.lo;
  cell_ = std::max(bounds.width(), bounds.height()) / cells;
  detour_ = bounds.width() + bounds.height();
  columns_ = std::max(1, static_cast<int>(std::ceil(bounds.width() / cell_)));
  rows_ = std::max(1, static_cast<int>(std::ceil(bounds.height() / cell_)));
  distances_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                    unreached);
  std::priority_queue<HeapEntry<float, std::size_t>> open;
  const auto reach = [&](std::size_t cell, double distance) {
    const auto d = static_cast<float>(distance);
    if (d >= distances_[cell]) return;
    distances_[cell] = d;
    open.push({d, cell});
  };
  reach(index(goal), distance(goal, centre(index(goal))));
  while (!open.empty()) {
    const auto [reached, from] = open.top();
    open.pop();
    if (reached > distances_[from]) continue;
    const int column = static_cast<int>(from) % columns_;
    const int row = static_cast<int>(from) / columns_;
    for (int j = std::max(0, row - 1); j <= std::min(rows_ - 1, row + 1); ++j) {
      for (int i = std::max(0, column - 1); i <= std::min(columns_ - 1, column + 1); ++i) {
        const std::size_t cell = cell_of(i, j);
        if (!map.is_free(Segment{centre(from), centre(cell)}, 0)) continue;
        const double step = i != column && j != row ? std::numbers::sqrt2 : 1.0;
        reach(cell, static_cast<double>(reached) + step * cell_);
      }
    }
  }
}

std::size_t GeodesicField::index(Vec2 p) const {
  const auto clamp = [&](double v, int count) {
    return static_cast<int>(std::clamp(v / cell_, 0.0, count - 1.0));
  };
  return cell_of(clamp(p.x - low_.x, columns_), clamp(p.y - low_.y, rows_));
}

Vec2 GeodesicField::centre(std::size_t cell) const {
  const int column = static_cast<int>(cell) % columns_;
  const int row = static_cast<int>(cell) / columns_;
  return low_ + cell_ * Vec2{column + 0.5, row + 0.5};
}

double GeodesicField::at(Vec2 p) const {
  const float found = distances_[index(p)];
  return found < unreached ? static_cast<double>(found) : distance(p, goal_) + detour_;
}

bool GeodesicField::reaches(Vec2 p) const { return distances_[index(p)] < unreached; }

double GeodesicField::seen_from(const Map& map, Vec2 p) const {
  const Vec2 own = centre(index(p));
  if (reaches(p) && map.is_free(Segment{p, own}, 0)) return at(p);
  const int column = static_cast<int>(index(p)) % columns_;
  const int row = static_cast<int>(index(p)) / columns_;
  double least = std::numeric_limits<double>::infinity();
  for (int j = std::max(0, row - 1); j <= std::min(rows_ - 1, row + 1); ++j) {
    for (int i = std::max(0, column - 1); i <= std::min(columns_ - 1, column + 1); ++i) {
      const std::size_t cell = cell_of(i, j);
      const double way = static_cast<double>(distances_[cell]) + distance(p, centre(cell));
      if (way < least && map.is_free(Segment{p, centre(cell)}, 0)) least = way;
    }
  }
  return std::isfinite(least) ? least : distance(p, goal_) + detour_;
}

}  // namespace microswarm
