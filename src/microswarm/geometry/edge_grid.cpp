// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/edge_grid.hpp"

#include <cassert>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

/// Relative bound on the rounding errors of a coordinate here.
constexpr double rounding = 1e-12;
/// Bounds that keep the number of cells far from memory limits and their size far from rounding.
constexpr int max_cells = 1 << 22;
constexpr double min_cell_in_slacks = 1e3;

double magnitude(Vec2 p) { return std::abs(p.x) + std::abs(p.y); }

/// Capsule tested against many edges, most of which pass beside it.
class Capsule {
 public:
  /// `reach` is the radius plus more than any rounding error here.
  Capsule(Segment s, double radius, double reach)
      : spine_(s), squared_radius_(radius * radius), along_(s.b - s.a) {
    const double length2 = squared_norm(along_);
    beside_ = reach * std::sqrt(length2);
    beyond_ = length2 + beside_;
  }

  bool is_clear_of(const Segment& e) const {
    const Vec2 a = e.a - spine_.a;
    const Vec2 b = e.b - spine_.a;
    const double height_a = cross(along_, a);
    const double height_b = cross(along_, b);
    const double along_a = dot(along_, a);
    const double along_b = dot(along_, b);
    // One branch for all four sides: it is nearly always taken, whichever side applies.
    const bool is_beside =
        (std::min(height_a, height_b) > beside_) | (std::max(height_a, height_b) < -beside_) |
        (std::min(along_a, along_b) > beyond_) | (std::max(along_a, along_b) < -beside_);
    if (is_beside) return true;
    return !intersects(spine_, e) && squared_distance(e.a, spine_) >= squared_radius_ &&
           squared_distance(e.b, spine_) >= squared_radius_ &&
           squared_distance(spine_.a, e) >= squared_radius_ &&
           squared_distance(spine_.b, e) >= squared_radius_;
  }

 private:
  Segment spine_;
  double squared_radius_;
  Vec2 along_;
  double beside_;
  double beyond_;
};

}  // namespace

class EdgeGrid::Sweep {
 public:
  /// Edges (reach 0) and queries (reach > 0) compute their rows with the same monotone rounding, so
  /// a shared point is never missed. Only columns clipped to a row need the slack.
  Sweep(const EdgeGrid& grid, Segment s, double reach)
      : grid_(grid), low_(s.a), high_(s.b), reach_(reach), margin_(reach + grid.slack_) {
    if (low_.y > high_.y) std::swap(low_, high_);
    left_ = std::min(low_.x, high_.x) - reach;
    right_ = std::max(low_.x, high_.x) + reach;
    if (bounds().overlaps(grid.box_)) {
      rows_ = {grid.row_of(low_.y - reach), grid.row_of(high_.y + reach)};
    }
    is_slanted_ = rows_.first != rows_.last && high_.y - low_.y > grid.slack_;
    if (is_slanted_) slope_ = (high_.x - low_.x) / (high_.y - low_.y);
  }

  Run rows() const { return rows_; }
  Box bounds() const { return {{left_, low_.y - reach_}, {right_, high_.y + reach_}}; }
  Run columns(int row) const {
    double left = left_;
    double right = right_;
    if (is_slanted_) {
      const double bottom = grid_.box_.lo.y + row * grid_.cell_ - margin_;
      const double enter = x_at(bottom);
      const double leave = x_at(bottom + grid_.cell_ + 2 * margin_);
      left = std::max(left, std::min(enter, leave) - margin_);
      right = std::min(right, std::max(enter, leave) + margin_);
    }
    return {grid_.column_of(left), grid_.column_of(right)};
  }

 private:
  double x_at(double y) const {
    return low_.x + (std::clamp(y, low_.y, high_.y) - low_.y) * slope_;
  }

  const EdgeGrid& grid_;
  Vec2 low_;
  Vec2 high_;
  double reach_;
  double margin_;
  double left_;
  double right_;
  double slope_ = 0;
  bool is_slanted_;
  Run rows_{0, -1};
};

void EdgeGrid::assign(std::span<const Segment> edges, std::span<const std::uint32_t> body_of,
                      double cell) {
  assert(edges.size() == body_of.size() && edges.size() < (1u << 31));
  edges_.assign(edges.begin(), edges.end());
  bodies_.assign(body_of.begin(), body_of.end());
  box_ = {};
  for (const Segment& e : edges_) {
    box_.include(e.a);
    box_.include(e.b);
  }
  if (empty()) {
    columns_ = rows_ = 0;
    return;
  }
  choose_cells(cell);
  fill_cells();
  find_windings();
}

void EdgeGrid::choose_cells(double cell) {
  const double count = static_cast<double>(size());
  slack_ = rounding * std::max(magnitude(box_.lo), magnitude(box_.hi));
  if (cell <= 0) {
    double length = 0;
    for (const Segment& e : edges_) length += magnitude(e.b - e.a);
    const double wide = std::max(box_.width(), box_.height());
    const double area =
        std::max(box_.width(), wide / count) * std::max(box_.height(), wide / count);
    cell = std::max(std::sqrt(area / (2 * count)), length / (4 * count));
  }
  const double budget = std::max<double>(max_cells, 4 * count);
  cell = std::max({cell, std::sqrt(box_.width() * box_.height() / budget),
                   (box_.width() + box_.height()) / budget, min_cell_in_slacks * slack_,
                   std::numeric_limits<double>::min()});
  cell_ = cell;
  per_cell_ = 1 / cell;
  columns_ = static_cast<int>(box_.width() * per_cell_) + 1;
  rows_ = static_cast<int>(box_.height() * per_cell_) + 1;
}

void EdgeGrid::fill_cells() {
  cells_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, {});
  auto for_each_cell = [&](const Segment& e, auto&& visit) {
    const Sweep sweep(*this, e, 0);
    for (int row = sweep.rows().first; row <= sweep.rows().last; ++row) {
      const Run columns = sweep.columns(row);
      Cell* cells = cells_.data() + static_cast<std::size_t>(row) * columns_;
      for (int column = columns.first; column <= columns.last; ++column) visit(cells[column]);
    }
  };
  for (const Segment& e : edges_) for_each_cell(e, [](Cell& c) { ++c.first; });
  std::uint32_t total = 0;
  for (Cell& c : cells_) c.first = total += c.first;
  ids_.resize(total);
  for (std::size_t i = size(); i-- > 0;) {
    for_each_cell(edges_[i], [&](Cell& c) { ids_[--c.first] = static_cast<std::uint32_t>(i); });
  }
}

// Every edge that crosses the height of a row's centres winds once around all centres to its left.
void EdgeGrid::find_windings() {
  for (const Segment& e : edges_) {
    if (e.a.y == e.b.y) continue;
    const int turn = e.b.y > e.a.y ? 1 : -1;
    auto is_left = [&](Vec2 p) { return orientation_beside(e.a, e.b, p) == turn; };
    const int last_row = row_of(std::max(e.a.y, e.b.y));
    for (int row = row_of(std::min(e.a.y, e.b.y)); row <= last_row; ++row) {
      const double y = centre_of(0, row).y;
      if ((e.a.y <= y) == (e.b.y <= y)) continue;
      const double x = e.a.x + (y - e.a.y) / (e.b.y - e.a.y) * (e.b.x - e.a.x);
      int left = column_of(x);
      while (left < columns_ && is_left(centre_of(left, row))) ++left;
      while (left > 0 && !is_left(centre_of(left - 1, row))) --left;
      if (left > 0) cells_[static_cast<std::size_t>(row) * columns_ + left - 1].winding += turn;
    }
  }
  for (int row = 0; row < rows_; ++row) {
    Cell* cells = cells_.data() + static_cast<std::size_t>(row) * columns_;
    for (int column = columns_ - 1; column > 0; --column) {
      cells[column - 1].winding += cells[column].winding;
    }
  }
}

int EdgeGrid::winding(Vec2 p) const {
  if (!box_.contains(p)) return 0;
  const int column = column_of(p.x);
  const int row = row_of(p.y);
  const Vec2 centre = centre_of(column, row);
  int sum = cells_[static_cast<std::size_t>(row) * columns_ + column].winding;
  for (const std::uint32_t id : edges_in(row, {column, column})) {
    sum -= winding_along(edges_[id].a, edges_[id].b, p, centre);
  }
  return sum;
}

bool EdgeGrid::in_solid(Vec2 p) const {
  if (!box_.contains(p)) return false;
  const int column = column_of(p.x);
  for (const std::uint32_t id : edges_in(row_of(p.y), {column, column})) {
    if (contains(edges_[id], p)) return true;
  }
  return winding(p) != 0;
}

void EdgeGrid::scan(Vec2 p, int row, Run columns, Found& best) const {
  for (const std::uint32_t id : edges_in(row, columns)) {
    const double d = microswarm::squared_distance(p, edges_[id]);
    if (d < best.squared || (d == best.squared && id < best.edge)) best = {d, id};
  }
}

// Extends a block of cells around p's cell by a row or column on its nearest side until that side
// is farther than the best edge.
EdgeGrid::Found EdgeGrid::search(Vec2 p, double squared_limit) const {
  Found best{squared_limit, size()};
  if (empty()) return best;
  const double slack = slack_ + rounding * magnitude(p);
  auto squared = [&](double gap) {
    gap = std::max(gap - slack, 0.0);
    return gap * gap;
  };
  const Vec2 o = p - box_.lo;
  const double outside_x = squared(std::max(-o.x, p.x - box_.hi.x));
  const double outside_y = squared(std::max(-o.y, p.y - box_.hi.y));
  Run columns{column_of(p.x), column_of(p.x)};
  Run rows{row_of(p.y), row_of(p.y)};
  scan(p, rows.first, columns, best);
  for (;;) {
    const double left =
        columns.first > 0 ? squared(o.x - columns.first * cell_) + outside_y : infinity;
    const double right = columns.last < columns_ - 1
                             ? squared((columns.last + 1) * cell_ - o.x) + outside_y
                             : infinity;
    const double bottom = rows.first > 0 ? squared(o.y - rows.first * cell_) + outside_x : infinity;
    const double top =
        rows.last < rows_ - 1 ? squared((rows.last + 1) * cell_ - o.y) + outside_x : infinity;
    const double nearest = std::min(std::min(left, right), std::min(bottom, top));
    if (nearest > best.squared || nearest == infinity) return best;
    if (nearest == bottom || nearest == top) {
      scan(p, nearest == bottom ? --rows.first : ++rows.last, columns, best);
    } else {
      const int column = nearest == left ? --columns.first : ++columns.last;
      for (int row = rows.first; row <= rows.last; ++row) scan(p, row, {column, column}, best);
    }
  }
}

double EdgeGrid::distance(Vec2 p, double limit) const {
  const Found found = search(p, limit * limit);
  return found.edge == size() ? limit : std::min(limit, std::sqrt(found.squared));
}

std::size_t EdgeGrid::nearest(Vec2 p, double limit) const { return search(p, limit * limit).edge; }

/// r plus more than any rounding error in the coordinates.
double EdgeGrid::reach_of(Segment s, double r) const {
  return r + slack_ + rounding * (r + magnitude(s.a) + magnitude(s.b));
}

/// The same answers, to the bit, as for the capsule whose two ends are `p`: the tests of a segment
/// rule out nothing there.
bool EdgeGrid::disc_free(Vec2 p, double r) const {
  const double reach = reach_of({p, p}, r);
  if (!Box{p, p}.grown(reach).overlaps(box_)) return true;
  const Run columns{column_of(p.x - reach), column_of(p.x + reach)};
  const int last_row = row_of(p.y + reach);
  const double squared = r * r;
  const double touching = (reach - r) * (reach - r);
  for (int row = row_of(p.y - reach); row <= last_row; ++row) {
    for (const std::uint32_t id : edges_in(row, columns)) {
      const Segment& e = edges_[id];
      const double to_edge = microswarm::squared_distance(p, e);
      if ((to_edge < squared) | (squared_norm(e.a - p) < squared) |
          (squared_norm(e.b - p) < squared))
        return false;
      if (to_edge <= touching && intersects({p, p}, e)) return false;
    }
  }
  return true;
}

bool EdgeGrid::capsule_free(Segment s, double r) const {
  if (empty()) return true;
  if (s.a == s.b) return disc_free(s.a, r);
  const double reach = reach_of(s, r);
  const Sweep sweep(*this, s, reach);
  const Capsule capsule(s, r, reach);
  for (int row = sweep.rows().first; row <= sweep.rows().last; ++row) {
    for (const std::uint32_t id : edges_in(row, sweep.columns(row))) {
      if (!capsule.is_clear_of(edges_[id])) return false;
    }
  }
  return true;
}

double EdgeGrid::distance(Segment s, double limit) const {
  if (empty()) return limit;
  double best = limit * limit;
  for (const Vec2 end : {s.a, s.b}) best = std::min(best, search(end, best).squared);
  const Sweep sweep(*this, s, reach_of(s, std::sqrt(best)));
  for (int row = sweep.rows().first; row <= sweep.rows().last; ++row) {
    for (const std::uint32_t id : edges_in(row, sweep.columns(row))) {
      best = std::min(best, squared_distance(s, edges_[id]));
    }
  }
  return best < limit * limit ? std::sqrt(best) : limit;
}

EdgeGrid::Run EdgeGrid::columns_of_edge(std::uint32_t edge, int row) const {
  const Sweep sweep(*this, edges_[edge], 0);
  if (row < sweep.rows().first) return {0, -1};
  return sweep.columns(row);
}

bool EdgeGrid::first_seen_in(std::uint32_t edge, int column, int row, Run wanted,
                             int first_row) const {
  if (column != std::max(wanted.first, columns_of_edge(edge, row).first)) return false;
  if (row == first_row) return true;
  const Run before = columns_of_edge(edge, row - 1);
  return before.first > before.last || before.last < wanted.first || before.first > wanted.last;
}

}  // namespace microswarm
