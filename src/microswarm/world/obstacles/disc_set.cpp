// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/disc_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm {
namespace {

constexpr std::size_t few_discs = 16;

Box segment_box(Segment s) {
  Box box;
  box.include(s.a);
  box.include(s.b);
  return box;
}

/// For r = 0, touching is not clear.
bool is_clear(double squared, double r, double radius) {
  const double reach = r + radius;
  return r > 0 ? squared >= reach * reach : squared > reach * reach;
}

}  // namespace

void DiscSet::assign(std::span<const Body> bodies) {
  discs_.clear();
  bodies_.clear();
  first_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    std::visit(Overloaded{[&](const Disc& disc) {
                            discs_.push_back(disc);
                            bodies_.push_back(static_cast<std::uint32_t>(i));
                          },
                          [](const Polygon&) {}},
               bodies[i].shape);
  }
  if (size() > few_discs) fill_buckets();
}

void DiscSet::fill_buckets() {
  Box box;
  double diameters = 0;
  for (const Disc& d : discs_) {
    const Box b = bounding_box(d);
    box.include(b.lo);
    box.include(b.hi);
    diameters += 2 * d.radius;
  }
  const double count = static_cast<double>(size());
  const double longest = std::max(box.width(), box.height());
  grid_ = {box,
           std::max({std::sqrt(box.width() * box.height() / (2 * count)), 0.5 * diameters / count,
                     longest / (4 * count), std::numeric_limits<double>::min()})};
  first_.assign(grid_.size() + 1, 0);
  auto for_each_cell = [&](const Disc& d, auto&& visit) {
    const Run columns = grid_.column_range(bounding_box(d)),
              rows = grid_.row_range(bounding_box(d));
    for (int row = rows.first; row <= rows.last; ++row)
      for (int column = columns.first; column <= columns.last; ++column)
        visit(first_[grid_.number(column, row)]);
  };
  for (const Disc& d : discs_) for_each_cell(d, [](std::uint32_t& n) { ++n; });
  std::uint32_t total = 0;
  for (std::uint32_t& n : first_) n = total += n;
  ids_.resize(total);
  for (std::size_t i = size(); i-- > 0;) {
    for_each_cell(discs_[i], [&](std::uint32_t& n) { ids_[--n] = static_cast<std::uint32_t>(i); });
  }
}

// Discs that span several cells are tested repeatedly, which is cheaper than avoiding it.
template <class Visit>
bool DiscSet::all_near(const Box& box, Visit&& is_clear_of) const {
  if (!bucketed()) return std::all_of(discs_.begin(), discs_.end(), is_clear_of);
  if (!box.overlaps(grid_.box())) return true;
  const Run columns = grid_.column_range(box), rows = grid_.row_range(box);
  for (int row = rows.first; row <= rows.last; ++row)
    for (const std::uint32_t id : discs_in(row, columns))
      if (!is_clear_of(discs_[id])) return false;
  return true;
}

/// The same along a segment: in each row only the columns that the capsule may pass.
template <class Visit>
bool DiscSet::all_near(Segment s, double r, Visit&& is_clear_of) const {
  if (!bucketed()) return std::all_of(discs_.begin(), discs_.end(), is_clear_of);
  const double slack = 1e-9 * (grid_.cell().x + std::abs(s.a.x) + std::abs(s.a.y) +
                               std::abs(s.b.x) + std::abs(s.b.y));
  const UniformGrid::Sweep near(grid_, s, r, slack);
  for (int row = near.rows().first; row <= near.rows().last; ++row)
    for (const std::uint32_t id : discs_in(row, near.columns(row)))
      if (!is_clear_of(discs_[id])) return false;
  return true;
}

bool DiscSet::is_free(Vec2 p, double r) const {
  return all_near(Box{p, p}.grown(r),
                  [&](const Disc& d) { return is_clear(squared_norm(p - d.centre), r, d.radius); });
}

bool DiscSet::is_free(Segment s, double r) const {
  const Vec2 middle = 0.5 * (s.a + s.b);
  const double half = 0.5 * distance(s.a, s.b) * (1 + 1e-12);
  return all_near(s, r, [&](const Disc& d) {
    const double reach = half + r + d.radius;
    return squared_norm(middle - d.centre) > reach * reach ||
           is_clear(squared_distance(d.centre, s), r, d.radius);
  });
}

// Searches square rings of cells around p's cell until nothing farther out can be nearer.
std::size_t DiscSet::nearest(Vec2 p, double limit) const {
  double best = limit;
  std::size_t found = size();
  auto ask = [&](std::size_t i) {
    const double d = distance(p, discs_[i].centre) - discs_[i].radius;
    if (d < best || (d == best && i < found)) {
      best = d;
      found = i;
    }
  };
  if (!bucketed()) {
    for (std::size_t i = 0; i < size(); ++i) ask(i);
    return found;
  }
  const int column = grid_.find_column(p.x), row = grid_.find_row(p.y);
  auto scan = [&](int r, int left, int right) {
    for (const std::uint32_t id : discs_in(r, {left, right})) ask(id);
  };
  for (int k = 0;; ++k) {
    const Run columns{std::max(column - k, 0), std::min(column + k, grid_.columns() - 1)};
    const Run rows{std::max(row - k, 0), std::min(row + k, grid_.rows() - 1)};
    for (int r = rows.first; r <= rows.last; ++r) {
      if (r == row - k || r == row + k) {
        scan(r, columns.first, columns.last);
        continue;
      }
      if (columns.first == column - k) scan(r, columns.first, columns.first);
      if (columns.last == column + k) scan(r, columns.last, columns.last);
    }
    const auto [left, right, bottom, top] = grid_.beyond(columns, rows, p);
    const double gap = std::min({left, right, bottom, top});
    if (gap == infinity || gap - 1e-9 * grid_.cell().x > best) return found;
  }
}

double DiscSet::clearance(Vec2 p, double limit) const {
  const std::size_t i = nearest(p, limit);
  return i == size() ? limit : std::min(limit, distance(p, discs_[i]));
}

double DiscSet::clearance(Segment s, double limit) const {
  if (empty()) return limit;
  double best = limit;
  if (bucketed()) best = std::min(clearance(s.a, limit), clearance(s.b, limit));
  for_each_in(segment_box(s).grown(best),
              [&](std::size_t i) { best = std::min(best, distance(s, discs_[i])); });
  return best;
}

}  // namespace microswarm
