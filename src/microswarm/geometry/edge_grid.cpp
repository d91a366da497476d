// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/edge_grid.hpp"

#include <cassert>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/geometry/l1_norm.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

/// Relative bound on the rounding errors of a coordinate here.
constexpr double rounding = 1e-12;
/// Bounds that keep the number of cells far from memory limits and their size far from rounding.
constexpr int max_cells = 1 << 22;
constexpr double min_cell_in_slacks = 1e3;

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

void EdgeGrid::assign(std::span<const Segment> edges, std::span<const std::uint32_t> enclosing_pose,
                      double cell) {
  assert(edges.size() == enclosing_pose.size() && edges.size() < (1u << 31));
  edges_.assign(edges.begin(), edges.end());
  bodies_.assign(enclosing_pose.begin(), enclosing_pose.end());
  Box box;
  for (const Segment& e : edges_) {
    box.include(e.a);
    box.include(e.b);
  }
  grid_ = empty() ? UniformGrid() : UniformGrid(box, choose_cell(box, cell));
  if (empty()) return;
  fill_cells();
  find_windings();
}

double EdgeGrid::choose_cell(const Box& box, double cell) {
  const double count = static_cast<double>(size());
  slack_ = rounding * std::max(l1_norm(box.lo), l1_norm(box.hi));
  if (cell <= 0) {
    double length = 0;
    for (const Segment& e : edges_) length += l1_norm(e.b - e.a);
    const double wide = std::max(box.width(), box.height());
    const double area = std::max(box.width(), wide / count) * std::max(box.height(), wide / count);
    cell = std::max(std::sqrt(area / (2 * count)), length / (4 * count));
  }
  const double budget = std::max<double>(max_cells, 4 * count);
  return std::max({cell, std::sqrt(box.width() * box.height() / budget),
                   (box.width() + box.height()) / budget, min_cell_in_slacks * slack_,
                   std::numeric_limits<double>::min()});
}

void EdgeGrid::fill_cells() {
  cells_.assign(grid_.size() + 1, {});
  auto for_each_cell = [&](const Segment& e, auto&& visit) {
    const UniformGrid::Sweep near = sweep(e, 0);
    for (int row = near.rows().first; row <= near.rows().last; ++row) {
      const Run columns = near.columns(row);
      Cell* cells = cells_.data() + grid_.number(0, row);
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
    const int last_row = grid_.find_row(std::max(e.a.y, e.b.y));
    for (int row = grid_.find_row(std::min(e.a.y, e.b.y)); row <= last_row; ++row) {
      const double y = grid_.cell_centre(0, row).y;
      if ((e.a.y <= y) == (e.b.y <= y)) continue;
      const double x = e.a.x + (y - e.a.y) / (e.b.y - e.a.y) * (e.b.x - e.a.x);
      int left = grid_.find_column(x);
      while (left < grid_.columns() && is_left(grid_.cell_centre(left, row))) ++left;
      while (left > 0 && !is_left(grid_.cell_centre(left - 1, row))) --left;
      if (left > 0) cells_[grid_.number(left - 1, row)].winding += turn;
    }
  }
  for (int row = 0; row < grid_.rows(); ++row) {
    Cell* cells = cells_.data() + grid_.number(0, row);
    for (int column = grid_.columns() - 1; column > 0; --column) {
      cells[column - 1].winding += cells[column].winding;
    }
  }
}

int EdgeGrid::winding(Vec2 p) const {
  if (!box().contains(p)) return 0;
  const int column = grid_.find_column(p.x);
  const int row = grid_.find_row(p.y);
  const Vec2 centre = grid_.cell_centre(column, row);
  int sum = cells_[grid_.number(column, row)].winding;
  for (const std::uint32_t id : edges_in(row, {column, column})) {
    sum -= winding_along(edges_[id].a, edges_[id].b, p, centre);
  }
  return sum;
}

bool EdgeGrid::in_solid(Vec2 p) const {
  if (!box().contains(p)) return false;
  const int column = grid_.find_column(p.x);
  for (const std::uint32_t id : edges_in(grid_.find_row(p.y), {column, column})) {
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
  const double slack = slack_ + rounding * l1_norm(p);
  auto squared = [&](double gap) {
    gap = std::max(gap - slack, 0.0);
    return gap * gap;
  };
  const double outside_x = squared(std::max(box().lo.x - p.x, p.x - box().hi.x));
  const double outside_y = squared(std::max(box().lo.y - p.y, p.y - box().hi.y));
  Run columns = grid_.column_range({p, p});
  Run rows = grid_.row_range({p, p});
  scan(p, rows.first, columns, best);
  for (;;) {
    const UniformGrid::Beyond beyond = grid_.beyond(columns, rows, p);
    const double left = squared(beyond.left) + outside_y;
    const double right = squared(beyond.right) + outside_y;
    const double bottom = squared(beyond.bottom) + outside_x;
    const double top = squared(beyond.top) + outside_x;
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
double EdgeGrid::padded_reach(Segment s, double r) const {
  return r + slack_ + rounding * (r + l1_norm(s.a) + l1_norm(s.b));
}

/// The same answers, to the bit, as for the capsule whose two ends are `p`: the tests of a segment
/// rule out nothing there.
bool EdgeGrid::disc_free(Vec2 p, double r) const {
  const double reach = padded_reach({p, p}, r);
  const Box near = Box{p, p}.grown(reach);
  if (!near.overlaps(box())) return true;
  const Run columns = grid_.column_range(near);
  const Run rows = grid_.row_range(near);
  const double squared = r * r;
  const double touching = (reach - r) * (reach - r);
  for (int row = rows.first; row <= rows.last; ++row) {
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
  const double reach = padded_reach(s, r);
  const UniformGrid::Sweep near = sweep(s, reach);
  const Capsule capsule(s, r, reach);
  for (int row = near.rows().first; row <= near.rows().last; ++row) {
    for (const std::uint32_t id : edges_in(row, near.columns(row))) {
      if (!capsule.is_clear_of(edges_[id])) return false;
    }
  }
  return true;
}

double EdgeGrid::distance(Segment s, double limit) const {
  if (empty()) return limit;
  double best = limit * limit;
  for (const Vec2 end : {s.a, s.b}) best = std::min(best, search(end, best).squared);
  const UniformGrid::Sweep near = sweep(s, padded_reach(s, std::sqrt(best)));
  for (int row = near.rows().first; row <= near.rows().last; ++row) {
    for (const std::uint32_t id : edges_in(row, near.columns(row))) {
      best = std::min(best, squared_distance(s, edges_[id]));
    }
  }
  return best < limit * limit ? std::sqrt(best) : limit;
}

EdgeGrid::Run EdgeGrid::columns_of_edge(std::uint32_t edge, int row) const {
  const UniformGrid::Sweep near = sweep(edges_[edge], 0);
  if (row < near.rows().first) return {};
  return near.columns(row);
}

bool EdgeGrid::first_seen_in(std::uint32_t edge, int column, int row, Run wanted,
                             int first_row) const {
  if (column != std::max(wanted.first, columns_of_edge(edge, row).first)) return false;
  if (row == first_row) return true;
  const Run before = columns_of_edge(edge, row - 1);
  return before.first > before.last || before.last < wanted.first || before.first > wanted.last;
}

}  // namespace microswarm
