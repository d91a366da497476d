// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/route.hpp"
#include "microswarm/core/heap_entry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace microswarm {
namespace {

constexpr float unreached = std::numeric_limits<float>::infinity();

constexpr std::array<std::array<int, 2>, 8> steps{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

}  // namespace

Route::Route(const Map& map, Vec2 goal, double clearance, double cell, std::size_t most_cells)
    : goal_(goal) {
  const Box& box = map.bounds();
  cell_ = std::max(cell, std::sqrt(box.width() * box.height() / static_cast<double>(most_cells)));
  // The goal is a node of the grid, so that the last step ends on it.
  const Vec2 before{std::floor((goal.x - box.lo.x) / cell_),
                    std::floor((goal.y - box.lo.y) / cell_)};
  origin_ = goal - cell_ * before;
  columns_ = static_cast<std::size_t>(std::max(1.0, std::ceil((box.hi.x - origin_.x) / cell_)));
  rows_ = static_cast<std::size_t>(std::max(1.0, std::ceil((box.hi.y - origin_.y) / cell_)));
  way_.assign(columns_ * rows_, unreached);
  next_.resize(way_.size());
  if (!box.contains(goal)) return;

  std::priority_queue<HeapEntry<float>> open;
  const auto root = static_cast<std::uint32_t>(cell_at(goal));
  way_[root] = 0;
  next_[root] = root;
  open.push({0, root});
  while (!open.empty()) {
    const auto [way, c] = open.top();
    open.pop();
    if (way > way_[c]) continue;
    const auto column = static_cast<long>(c % columns_);
    const auto row = static_cast<long>(c / columns_);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const long i = column + steps[k][0];
      const long j = row + steps[k][1];
      if (i < 0 || j < 0 || i >= static_cast<long>(columns_) || j >= static_cast<long>(rows_))
        continue;
      const auto n = static_cast<std::uint32_t>(static_cast<std::size_t>(j) * columns_ +
                                                static_cast<std::size_t>(i));
      const double length = k < 4 ? cell_ : cell_ * std::numbers::sqrt2;
      const auto longer = static_cast<float>(way + length);
      if (longer >= way_[n] || !map.is_free(Segment{centre(n), centre(c)}, clearance)) continue;
      way_[n] = longer;
      next_[n] = c;
      open.push({longer, n});
    }
  }
}

Vec2 Route::centre(std::size_t cell) const {
  const std::size_t row = cell / columns_;
  return origin_ +
         cell_ * Vec2{static_cast<double>(cell - row * columns_), static_cast<double>(row)};
}

std::size_t Route::cell_at(Vec2 p) const {
  const double i = std::round((p.x - origin_.x) / cell_);
  const double j = std::round((p.y - origin_.y) / cell_);
  const auto clamped = [](double v, std::size_t n) {
    return static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(n - 1)));
  };
  const std::size_t column = clamped(i, columns_);
  const std::size_t row = clamped(j, rows_);
  // Near a wall the own cell may be closed: take the best of the cells around it.
  std::size_t best = row * columns_ + column;
  if (way_[best] != unreached) return best;
  for (std::size_t r = row - std::min<std::size_t>(row, 2); r <= std::min(row + 2, rows_ - 1); ++r)
    for (std::size_t c = column - std::min<std::size_t>(column, 2);
         c <= std::min(column + 2, columns_ - 1); ++c)
      if (way_[r * columns_ + c] < way_[best]) best = r * columns_ + c;
  return best;
}

double Route::way_from(Vec2 p) const {
  if (way_.empty()) return std::numeric_limits<double>::infinity();
  return static_cast<double>(way_[cell_at(p)]);
}

Vec2 Route::ahead(const Map& map, Vec2 p, double reach, double r) const {
  if (way_.empty()) return p;
  std::size_t cell = cell_at(p);
  if (way_[cell] == unreached) return p;
  Vec2 seen = p;
  bool lost = false;
  double along = 0;
  // The first points may be hidden by the cell's own rounding; afterwards the first hidden one ends
  // it.
  while (along <= reach && !lost) {
    const Vec2 q = centre(cell);
    if (map.is_free(Segment{p, q}, r))
      seen = q;
    else
      lost = along > 2 * cell_ && !(seen == p);
    if (next_[cell] == cell) break;
    along += distance(q, centre(next_[cell]));
    cell = next_[cell];
  }
  return seen == p ? centre(cell) : seen;
}

}  // namespace microswarm
