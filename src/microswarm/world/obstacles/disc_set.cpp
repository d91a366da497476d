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

Box box_of(Segment s) {
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
  box_ = {};
  double diameters = 0;
  for (const Disc& d : discs_) {
    const Box b = bounding_box(d);
    box_.include(b.lo);
    box_.include(b.hi);
    diameters += 2 * d.radius;
  }
  const double count = static_cast<double>(size());
  const double longest = std::max(box_.width(), box_.height());
  cell_ = std::max({std::sqrt(box_.width() * box_.height() / (2 * count)), 0.5 * diameters / count,
                    longest / (4 * count), std::numeric_limits<double>::min()});
  per_cell_ = 1 / cell_;
  columns_ = static_cast<int>(box_.width() * per_cell_) + 1;
  rows_ = static_cast<int>(box_.height() * per_cell_) + 1;
  first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  auto for_each_cell = [&](const Disc& d, auto&& visit) {
    const Box b = bounding_box(d);
    for (int row = row_of(b.lo.y); row <= row_of(b.hi.y); ++row) {
      for (int column = column_of(b.lo.x); column <= column_of(b.hi.x); ++column) {
        visit(first_[static_cast<std::size_t>(row) * columns_ + column]);
      }
    }
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
  if (!box.overlaps(box_)) return true;
  const Run columns{column_of(box.lo.x), column_of(box.hi.x)};
  const Run rows{row_of(box.lo.y), row_of(box.hi.y)};
  for (int row = rows.first; row <= rows.last; ++row) {
    const std::uint32_t* first = first_.data() + static_cast<std::size_t>(row) * columns_;
    for (std::uint32_t k = first[columns.first]; k < first[columns.last + 1]; ++k) {
      if (!is_clear_of(discs_[ids_[k]])) return false;
    }
  }
  return true;
}

/// The same along a segment: in each row only the columns that the capsule may pass.
template <class Visit>
bool DiscSet::all_near(Segment s, double r, Visit&& is_clear_of) const {
  const Box box = box_of(s).grown(r);
  if (!bucketed() || row_of(box.lo.y) == row_of(box.hi.y)) return all_near(box, is_clear_of);
  if (!box.overlaps(box_)) return true;
  const bool rises = s.a.y < s.b.y;
  const Vec2 low = rises ? s.a : s.b, high = rises ? s.b : s.a;
  // Exceeds any rounding error here.
  const double margin =
      r + 1e-9 * (cell_ + std::abs(low.x) + std::abs(low.y) + std::abs(high.x) + std::abs(high.y));
  const double slope = (high.x - low.x) / (high.y - low.y);
  const bool is_slanted = high.y - low.y > margin - r;
  const auto x_at = [&](double y) {
    return low.x + (std::clamp(y, low.y, high.y) - low.y) * slope;
  };
  const Run rows{row_of(box.lo.y), row_of(box.hi.y)};
  for (int row = rows.first; row <= rows.last; ++row) {
    double left = box.lo.x, right = box.hi.x;
    if (is_slanted) {
      const double bottom = box_.lo.y + row * cell_ - margin;
      const double enter = x_at(bottom), leave = x_at(bottom + cell_ + 2 * margin);
      left = std::max(left, std::min(enter, leave) - margin);
      right = std::min(right, std::max(enter, leave) + margin);
    }
    const std::uint32_t* first = first_.data() + static_cast<std::size_t>(row) * columns_;
    for (std::uint32_t k = first[column_of(left)]; k < first[column_of(right) + 1]; ++k)
      if (!is_clear_of(discs_[ids_[k]])) return false;
  }
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
  const int column = column_of(p.x);
  const int row = row_of(p.y);
  auto scan = [&](int r, int left, int right) {
    const std::uint32_t* first = first_.data() + static_cast<std::size_t>(r) * columns_;
    for (std::uint32_t k = first[left]; k < first[right + 1]; ++k) ask(ids_[k]);
  };
  for (int k = 0;; ++k) {
    const Run columns{std::max(column - k, 0), std::min(column + k, columns_ - 1)};
    const Run rows{std::max(row - k, 0), std::min(row + k, rows_ - 1)};
    for (int r = rows.first; r <= rows.last; ++r) {
      if (r == row - k || r == row + k) {
        scan(r, columns.first, columns.last);
        continue;
      }
      if (columns.first == column - k) scan(r, columns.first, columns.first);
      if (columns.last == column + k) scan(r, columns.last, columns.last);
    }
    double gap = infinity;
    const Vec2 o = p - box_.lo;
    if (columns.first > 0) gap = std::min(gap, o.x - columns.first * cell_);
    if (columns.last < columns_ - 1) gap = std::min(gap, (columns.last + 1) * cell_ - o.x);
    if (rows.first > 0) gap = std::min(gap, o.y - rows.first * cell_);
    if (rows.last < rows_ - 1) gap = std::min(gap, (rows.last + 1) * cell_ - o.y);
    if (gap == infinity || gap - 1e-9 * cell_ > best) return found;
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
  for_each_in(box_of(s).grown(best),
              [&](std::size_t i) { best = std::min(best, distance(s, discs_[i])); });
  return best;
}

}  // namespace microswarm
