// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/trapezoids.hpp"
#include "microswarm/geometry/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace microswarm {
namespace {

/// Side of p relative to a segment from left to right: +1 above.
int side_from(const Segment& s, Vec2 p) { return orientation(s.a, s.b, p); }

}  // namespace

/// Sweeps a vertical line from left to right over the ends.
class Trapezoids::Sweep {
 public:
  explicit Sweep(Trapezoids& made) : made_(made), active_(Below{made.segments_}) {}

  void run() {
    const auto& segments = made_.segments_;
    std::vector<std::uint32_t> order(segments.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, [&](std::uint32_t i, std::uint32_t j) {
      return is_left_of(segments[i].a, segments[j].a);
    });
    lowest_ = open(none, none, none);
    std::size_t next = 0;
    for (std::uint32_t point = 0; point < made_.points_.size(); ++point) {
      begins_.clear();
      for (; next < order.size() && segments[order[next]].a == made_.points_[point]; ++next)
        begins_.push_back(order[next]);
      made_.first_left_of_.push_back(static_cast<std::uint32_t>(made_.ends_.size()));
      pass(point);
    }
    made_.first_left_of_.push_back(static_cast<std::uint32_t>(made_.ends_.size()));
    made_.first_right_of_.push_back(static_cast<std::uint32_t>(made_.cells_.size()));
  }

 private:
  /// A segment that the line crosses, and the open cell above it.
  struct Active {
    std::uint32_t segment;
    mutable std::uint32_t cell;
  };
  struct Below {
    using is_transparent = void;
    const std::vector<Segment>& segments;
    bool operator()(const Active& x, const Active& y) const {
      const Segment& a = segments[x.segment];
      const Segment& b = segments[y.segment];
      if (is_left_of(a.a, b.a)) {
        const int side = side_from(a, b.a);
        return (side != 0 ? side : side_from(a, b.b)) > 0;
      }
      const int side = side_from(b, a.a);
      return (side != 0 ? side : side_from(b, a.b)) < 0;
    }
    bool operator()(const Active& x, Vec2 p) const { return side_from(segments[x.segment], p) > 0; }
    bool operator()(Vec2 p, const Active& x) const { return side_from(segments[x.segment], p) < 0; }
  };
  using Line = std::multiset<Active, Below>;

  std::uint32_t open(std::uint32_t bottom, std::uint32_t top, std::uint32_t left) {
    made_.cells_.push_back({.bottom = bottom, .top = top, .left = left});
    return static_cast<std::uint32_t>(made_.cells_.size() - 1);
  }
  void close(std::uint32_t cell, std::uint32_t point) {
    made_.cells_[cell].right = point;
    made_.ends_.push_back(cell);
  }

  /// Ends the cells to the left of the point and begins those to its right.
  void pass(std::uint32_t point) {
    const Vec2 p = made_.points_[point];
    auto& cells = made_.cells_;
    const auto first = active_.lower_bound(p);
    const auto last = active_.upper_bound(p);
    const bool is_lowest = first == active_.begin();
    const auto beneath = is_lowest ? active_.end() : std::prev(first);
    const std::uint32_t bottom = is_lowest ? none : beneath->segment;
    const std::uint32_t lower = is_lowest ? lowest_ : beneath->cell;
    std::uint32_t upper = lower;
    close(lower, point);
    for (auto it = first; it != last; ++it) {
      close(upper = it->cell, point);
      // A segment that only touches the point continues behind it.
      if (made_.segments_[it->segment].b != p) begins_.push_back(it->segment);
    }
    const std::uint32_t top = cells[upper].top;
    const auto above = active_.erase(first, last);
    std::ranges::sort(begins_, [&](std::uint32_t i, std::uint32_t j) {
      const int turn = orientation(p, made_.segments_[i].b, made_.segments_[j].b);
      return turn != 0 ? turn > 0 : i < j;
    });
    made_.first_right_of_.push_back(static_cast<std::uint32_t>(cells.size()));
    const std::uint32_t over = begins_.empty() ? top : begins_.front();
    const std::uint32_t begun = open(bottom, over, point);
    (is_lowest ? lowest_ : beneath->cell) = begun;
    cells[begun].left_below = lower;
    cells[lower].right_below = begun;
    std::uint32_t newest = begun;
    for (std::size_t i = 0; i < begins_.size(); ++i) {
      newest = open(begins_[i], i + 1 < begins_.size() ? begins_[i + 1] : top, point);
      active_.insert(above, {begins_[i], newest});
    }
    cells[newest].left_above = upper;
    cells[upper].right_above = newest;
  }

  Trapezoids& made_;
  Line active_;
  std::uint32_t lowest_ = none;  ///< open cell under every segment
  std::vector<std::uint32_t> begins_;
};

Trapezoids::Trapezoids(std::vector<Segment> segments) : segments_(std::move(segments)) {
  std::erase_if(segments_, [](const Segment& s) { return s.a == s.b; });
  for (Segment& s : segments_) {
    if (is_left_of(s.b, s.a)) std::swap(s.a, s.b);
    points_.insert(points_.end(), {s.a, s.b});
  }
  std::ranges::sort(points_, is_left_of);
  points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  cells_.reserve(3 * segments_.size() + 1);
  Sweep(*this).run();
  first_above_.assign(segments_.size() + 2, 0);
  const auto of = [&](const Cell& cell) {
    return cell.bottom == none ? segments_.size() : std::size_t{cell.bottom};
  };
  for (const Cell& cell : cells_) ++first_above_[of(cell) + 1];
  std::partial_sum(first_above_.begin(), first_above_.end(), first_above_.begin());
  above_.resize(cells_.size());
  auto next = first_above_;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) above_[next[of(cells_[i])]++] = i;
  const std::vector<std::uint32_t> bodies(segments_.size(), 0);
  if (!segments_.empty()) grid_.assign(segments_, bodies);
}

std::uint32_t Trapezoids::point_at(Vec2 p) const {
  const auto found = std::ranges::lower_bound(points_, p, is_left_of);
  if (found == points_.end() || *found != p) return none;
  return static_cast<std::uint32_t>(found - points_.begin());
}

std::uint32_t Trapezoids::cell_at(Vec2 p) const {
  std::size_t beneath = segments_.size();
  const auto take = [&](std::size_t i) {
    const Segment& s = segments_[i];
    if (!is_left_of(s.a, p) || !is_left_of(p, s.b) || side_from(s, p) < 0) return;
    // The higher one of two that do not cross: the one that begins later is above the other.
    if (beneath == segments_.size()) {
      beneath = i;
      return;
    }
    const Segment& now = segments_[beneath];
    const int side = is_left_of(now.a, s.a) ? side_from(now, s.a) : -side_from(s, now.a);
    const int far = is_left_of(s.b, now.b) ? side_from(now, s.b) : -side_from(s, now.b);
    if (side > 0 || (side == 0 && far > 0)) beneath = i;
  };
  if (!grid_.empty()) {
    const double lowest = grid_.box().lo.y;
    double low = p.y;
    for (double depth = grid_.cell(); beneath == segments_.size() && low >= lowest; depth *= 4)
      grid_.for_each_in({{p.x, low = p.y - depth}, p}, take);
    // What was found may reach below the box; then another one is perhaps above it there.
    if (beneath != segments_.size()) {
      const double foot = std::min(segments_[beneath].a.y, segments_[beneath].b.y);
      if (foot < low) grid_.for_each_in({{p.x, foot}, p}, take);
    }
  }
  const auto* begin = &above_[first_above_[beneath]];
  const auto* end = &above_[0] + first_above_[beneath + 1];
  // The last cell that begins to the left of p.
  const auto* found = std::partition_point(begin, end, [&](std::uint32_t cell) {
    const std::uint32_t left = cells_[cell].left;
    return left == none || is_left_of(points_[left], p) || points_[left] == p;
  });
  return found == begin ? *begin : *(found - 1);
}

std::vector<std::uint32_t> Trapezoids::cells_around(
    std::span<const std::uint32_t, 4> quadrilateral) const {
  std::vector<std::uint32_t> around;
  const std::uint32_t first = quadrilateral.front(), last = quadrilateral.back();
  for (std::uint32_t i = first_left_of_[first]; i < first_left_of_[first + 1]; ++i)
    around.push_back(ends_[i]);
  for (std::uint32_t i = first_right_of_[last]; i < first_right_of_[last + 1]; ++i)
    around.push_back(i);
  // Along its lower and its upper side, from cell to cell.
  const auto walk = [&](std::uint32_t cell, auto Cell::*near, auto Cell::*far) {
    while (cell != none) {
      around.push_back(cell);
      const Cell& here = cells_[cell];
      if (here.right == last || here.right == none) return;
      cell = here.*near != none ? here.*near : here.*far;
    }
  };
  walk(first_right_of_[first], &Cell::right_above, &Cell::right_below);
  walk(first_right_of_[first + 1] - 1, &Cell::right_below, &Cell::right_above);
  return around;
}

Box Trapezoids::bounding_box(std::uint32_t cell) const {
  const Cell& here = cells_[cell];
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{{-far, -far}, {far, far}};
  if (here.left != none) box.lo.x = points_[here.left].x;
  if (here.right != none) box.hi.x = points_[here.right].x;
  // A segment is lowest and highest where it or the cell ends.
  const auto y_at = [&](const Segment& s, double x) {
    if (x <= s.a.x) return s.a.y;
    return x >= s.b.x ? s.b.y : s.a.y + (s.b.y - s.a.y) * ((x - s.a.x) / (s.b.x - s.a.x));
  };
  if (here.bottom != none) {
    const Segment& s = segments_[here.bottom];
    box.lo.y = s.a.x == s.b.x ? s.a.y : std::min(y_at(s, box.lo.x), y_at(s, box.hi.x));
  }
  if (here.top != none) {
    const Segment& s = segments_[here.top];
    box.hi.y = s.a.x == s.b.x ? s.b.y : std::max(y_at(s, box.lo.x), y_at(s, box.hi.x));
  }
  return box;
}

}  // namespace microswarm
