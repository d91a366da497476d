// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/point_grid.hpp"

#include <cassert>

namespace microswarm {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t first_points = 32;
constexpr double cells_per_point = 2;
constexpr std::uint32_t crowded = 16;
constexpr double cells_of_split = 64;
/// Share of a coordinate that no rounding error here exceeds.
constexpr double rounding = 1e-12;

}  // namespace

PointGrid::PointGrid(const Box& box) : box_(box) { clear(); }

void PointGrid::clear() {
  points_.clear();
  next_.clear();
  rebuild();
}

std::uint32_t PointGrid::add_grid(const Box& box, double cells) {
  const double width = std::max(0.0, box.width());
  const double height = std::max(0.0, box.height());
  const double magnitude = std::abs(box.lo.x) + std::abs(box.lo.y) + width + height;
  Grid grid;
  grid.origin = width + height >= 0 && is_finite(box.lo) ? box.lo : Vec2{};
  grid.slack = std::isfinite(magnitude) ? rounding * magnitude : 0;
  grid.cell = std::max({std::sqrt(width * height / cells), (width + height) / cells,
                        1e3 * grid.slack, std::numeric_limits<double>::min()});
  if (!std::isfinite(grid.cell)) grid.cell = 1;
  grid.per_cell = 1 / grid.cell;
  grid.columns = static_cast<int>(std::min(width * grid.per_cell, cells)) + 1;
  grid.rows = static_cast<int>(std::min(height * grid.per_cell, cells)) + 1;
  grid.cells = static_cast<std::uint32_t>(cells_.size());
  cells_.resize(cells_.size() + static_cast<std::size_t>(grid.columns) * grid.rows);
  grids_.push_back(grid);
  return static_cast<std::uint32_t>(grids_.size() - 1);
}

void PointGrid::add(Vec2 p) {
  assert(is_finite(p) && size() < none);
  points_.push_back(p);
  next_.push_back(none);
  if (size() > rebuild_at_) {
    rebuild();
  } else {
    insert(static_cast<std::uint32_t>(size() - 1));
  }
}

void PointGrid::rebuild() {
  grids_.clear();
  cells_.clear();
  const double cells = cells_per_point * static_cast<double>(std::max(first_points, 2 * size()));
  rebuild_at_ = static_cast<std::size_t>(cells / cells_per_point);
  Box box = box_;
  if (!empty()) box = bounding_box(points_);
  add_grid(box, cells);
  for (std::uint32_t i = 0; i < size(); ++i) insert(i);
}

void PointGrid::insert(std::uint32_t point) {
  const Vec2 p = points_[point];
  std::uint32_t g = 0;
  for (;;) {
    const Grid& grid = grids_[g];
    const std::size_t c = grid.cells + static_cast<std::size_t>(grid.row_of(p.y)) * grid.columns +
                          grid.column_of(p.x);
    Cell& cell = cells_[c];
    if (cell.grid != none) {
      g = cell.grid;
      continue;
    }
    next_[point] = cell.first;
    cell.first = point;
    if (++cell.count >= crowded && (cell.count & (cell.count - 1)) == 0) split(cell);
    return;
  }
}

// Points that are all but equal cannot be parted; they stay a chain until it has doubled.
void PointGrid::split(Cell& crowd) {
  const Cell old = crowd;
  Box box;
  for (std::uint32_t i = old.first; i != none; i = next_[i]) box.include(points_[i]);
  const std::size_t position = static_cast<std::size_t>(&crowd - cells_.data());
  const std::uint32_t g = add_grid(box, cells_of_split);
  const Grid grid = grids_[g];
  if (grid.columns * grid.rows == 1) {
    cells_.resize(grid.cells);
    grids_.pop_back();
    return;
  }
  cells_[position] = {none, 0, g};
  for (std::uint32_t i = old.first; i != none;) {
    const Vec2 p = points_[i];
    Cell& cell = cells_[grid.cells + static_cast<std::size_t>(grid.row_of(p.y)) * grid.columns +
                        grid.column_of(p.x)];
    const std::uint32_t following = next_[i];
    next_[i] = cell.first;
    cell.first = i;
    ++cell.count;
    i = following;
  }
}

void PointGrid::scan(const Cell& cell, Vec2 p, Found& best) const {
  if (cell.grid != none) return search(grids_[cell.grid], p, best);
  for (std::uint32_t i = cell.first; i != none; i = next_[i]) {
    const double d = squared_norm(points_[i] - p);
    if (d < best.squared || (d == best.squared && i < best.point)) best = {d, i};
  }
}

// Square rings of cells around p's own, until nothing beyond them can be nearer.
void PointGrid::search(const Grid& grid, Vec2 p, Found& best) const {
  const int column = grid.column_of(p.x);
  const int row = grid.row_of(p.y);
  const double slack = grid.slack + rounding * (std::abs(p.x) + std::abs(p.y));
  const Vec2 o = p - grid.origin;
  for (int k = 0;; ++k) {
    const int left = std::max(column - k, 0);
    const int right = std::min(column + k, grid.columns - 1);
    const int bottom = std::max(row - k, 0);
    const int top = std::min(row + k, grid.rows - 1);
    for (int r = bottom; r <= top; ++r) {
      const Cell* cells = cells_.data() + grid.cells + static_cast<std::size_t>(r) * grid.columns;
      if (r == row - k || r == row + k) {
        for (int c = left; c <= right; ++c) scan(cells[c], p, best);
      } else {
        if (left == column - k) scan(cells[left], p, best);
        if (right == column + k) scan(cells[right], p, best);
      }
    }
    double gap = infinity;
    if (left > 0) gap = std::min(gap, o.x - left * grid.cell);
    if (right < grid.columns - 1) gap = std::min(gap, (right + 1) * grid.cell - o.x);
    if (bottom > 0) gap = std::min(gap, o.y - bottom * grid.cell);
    if (top < grid.rows - 1) gap = std::min(gap, (top + 1) * grid.cell - o.y);
    if (gap == infinity) return;
    gap = std::max(gap - slack, 0.0);
    if (gap * gap > best.squared) return;
  }
}

std::uint32_t PointGrid::nearest(Vec2 p) const {
  assert(!empty());
  Found best{infinity, none};
  search(grids_[0], p, best);
  return best.point;
}

void PointGrid::collect(const Grid& grid, Vec2 p, double radius,
                        std::vector<std::uint32_t>& out) const {
  const double reach = radius + grid.slack + rounding * (radius + std::abs(p.x) + std::abs(p.y));
  const int right = grid.column_of(p.x + reach);
  const int top = grid.row_of(p.y + reach);
  for (int row = grid.row_of(p.y - reach); row <= top; ++row) {
    const Cell* cells = cells_.data() + grid.cells + static_cast<std::size_t>(row) * grid.columns;
    for (int column = grid.column_of(p.x - reach); column <= right; ++column) {
      const Cell& cell = cells[column];
      if (cell.grid != none) {
        collect(grids_[cell.grid], p, radius, out);
        continue;
      }
      for (std::uint32_t i = cell.first; i != none; i = next_[i]) {
        if (squared_norm(points_[i] - p) <= radius * radius) out.push_back(i);
      }
    }
  }
}

void PointGrid::within(Vec2 p, double radius, std::vector<std::uint32_t>& out) const {
  const auto start = static_cast<std::ptrdiff_t>(out.size());
  collect(grids_[0], p, radius, out);
  std::sort(out.begin() + start, out.end());
}

}  // namespace microswarm
