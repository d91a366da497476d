// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {

/// Decomposition of the plane into trapezoids by vertical walls through the ends of segments, each
/// wall from an end up and down to the next segment. Of points with equal x the upper one counts
/// as farther right, which replaces every special case. Segments may touch; where they cross, some
/// cells are wrong. Immutable, shared by threads.
class Trapezoids {
 public:
  static constexpr std::uint32_t none = ~0u;

  /// Convex cell between two segments and the walls through two points. Neighbours are reached
  /// through the wall above or below its point.
  struct Cell {
    std::uint32_t bottom = none;  ///< segment; none: the cell is unbounded
    std::uint32_t top = none;
    std::uint32_t left = none;  ///< point
    std::uint32_t right = none;
    std::uint32_t left_below = none;  ///< cell
    std::uint32_t left_above = none;
    std::uint32_t right_below = none;
    std::uint32_t right_above = none;
  };

  Trapezoids() = default;
  explicit Trapezoids(std::vector<Segment> segments);

  std::span<const Cell> cells() const { return cells_; }
  /// The different ends of the segments, from left to right.
  std::span<const Vec2> points() const { return points_; }
  /// Each from left to right.
  std::span<const Segment> segments() const { return segments_; }
  /// Number of a point; none if it is no end of a segment.
  std::uint32_t point_at(Vec2 p) const;
  /// The cell that holds `p`, the one above if it is on a segment.
  std::uint32_t cell_at(Vec2 p) const;

  /// Looks around from `from`: calls point(number) for every end that is seen, and segments(bottom,
  /// top) for the segments around every cell that is seen, of which a few are not seen themselves.
  template <class OnPoint, class OnSegments>
  void look_around(Vec2 from, OnPoint&& point, OnSegments&& segments) const;
  /// The same step by step, what is near the way to a goal first.
  class Look;
  /// The same from all over a disc in which a quadrilateral is inscribed, whose corners are the
  /// points with these numbers, from left to right; nothing else is in the disc. A few more than
  /// are seen are called.
  template <class OnPoint, class OnSegments>
  void look_around(const Disc& from, std::span<const std::uint32_t, 4> inscribed, OnPoint&& point,
                   OnSegments&& segments) const;

 private:
  class Sweep;

  /// What is seen in a cell: the directions between those to two points.
  struct Cone {
    std::uint32_t cell;
    std::uint32_t lower;  ///< point; none: straight down
    std::uint32_t upper;
  };
  using Cones = std::vector<Cone>;
  /// Cells that are to be looked through, from the nearest on.
  template <bool rightwards>
  class Front;

  /// Looks from one place. Exact.
  struct FromPoint {
    Vec2 place;
    /// Whether p is above (+1) or below (−1) the direction to `lower`, looking to the right.
    int over(Vec2 lower, Vec2 p) const { return orientation(place, lower, p); }
    int under(Vec2 upper, Vec2 p) const { return orientation(place, upper, p); }
  };
  /// Looks from everywhere in a disc: above `lower` for one of the places, and below `upper`.
  struct FromDisc {
    Disc disc;
    int over(Vec2 lower, Vec2 p) const { return side(lower, p, disc.radius); }
    int under(Vec2 upper, Vec2 p) const { return side(upper, p, -disc.radius); }
    int side(Vec2 towards, Vec2 p, double radius) const {
      const Vec2 on = p - towards;
      const double turn = cross(towards - disc.centre, on) + radius * norm(on);
      return (turn > 0) - (turn < 0);
    }
  };
  template <bool rightwards, class Source, class OnPoint, class OnSegments, class Push>
  void look_through(const Cone& cone, const Source& source, OnPoint& point, OnSegments& segments,
                    Push&& push) const;
  template <bool rightwards, class Source, class OnPoint, class OnSegments>
  void look(const Source& source, Cones& cones, OnPoint& point, OnSegments& segments) const;
  template <bool rightwards, class OnPoint, class OnSegments>
  void look_once(const FromDisc& source, const Cones& starts, OnPoint& point,
                 OnSegments& segments) const;
  void start_around(std::span<const std::uint32_t, 4> inscribed, Cones& cones) const;

  std::vector<Segment> segments_;  ///< from left to right
  std::vector<Vec2> points_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> first_right_of_;  ///< of each point: cells that begin at it
  std::vector<std::uint32_t> first_left_of_;   ///< of each point: in ends_, cells that end at it
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> first_above_;  ///< of each segment and of none: in above_
  std::vector<std::uint32_t> above_;        ///< cells above a segment, from left to right
  EdgeGrid grid_;
};

/// Order from left to right, of equal x from below.
inline bool is_left_of(Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

/// Looks through one cell, and calls push(cone) for the cells beyond.
template <bool rightwards, class Source, class OnPoint, class OnSegments, class Push>
void Trapezoids::look_through(const Cone& cone, const Source& source, OnPoint& point,
                              OnSegments& segments, Push&& push) const {
  const Cell& cell = cells_[cone.cell];
  segments(cell.bottom, cell.top);
  const std::uint32_t end = rightwards ? cell.right : cell.left;
  if (end == none) return;
  const Vec2 p = points_[end];
  int over = 1, under = 1;
  if (cone.lower != none) {
    const Vec2 lower = points_[cone.lower];
    over = rightwards ? source.over(lower, p) : -source.under(lower, p);
  }
  if (cone.upper != none) {
    const Vec2 upper = points_[cone.upper];
    under = rightwards ? -source.under(upper, p) : source.over(upper, p);
  }
  if (over >= 0 && under >= 0) point(end);
  const std::uint32_t below = rightwards ? cell.right_below : cell.left_below;
  const std::uint32_t above = rightwards ? cell.right_above : cell.left_above;
  if (below != none && over > 0) push(Cone{below, cone.lower, under > 0 ? end : cone.upper});
  if (above != none && under > 0) push(Cone{above, over > 0 ? end : cone.lower, cone.upper});
}

template <bool rightwards, class Source, class OnPoint, class OnSegments>
void Trapezoids::look(const Source& source, Cones& cones, OnPoint& point,
                      OnSegments& segments) const {
  while (!cones.empty()) {
    const Cone cone = cones.back();
    cones.pop_back();
    look_through<rightwards>(cone, source, point, segments,
                             [&](const Cone& next) { cones.push_back(next); });
  }
}

/// Cells that are to be looked through, from the nearest on.
template <bool rightwards>
class Trapezoids::Front {
 public:
  explicit Front(std::span<const Cell> cells) : cells_(cells) {}
  bool empty() const { return open_.empty(); }
  /// `from` is the neighbour that it is seen through; none: it is where one stands.
  void push(const Cone& cone, std::uint32_t from) {
    open_.push_back({key(cone.cell), from, cone});
    std::push_heap(open_.begin(), open_.end());
  }
  /// The next cell, with all that is seen of it. What is seen through the lower neighbour is below
  /// what is seen through the upper one.
  Cone pop() {
    Entry entry = take();
    while (!open_.empty() && open_.front().cone.cell == entry.cone.cell) {
      const Entry other = take();
      const std::uint32_t above =
          rightwards ? cells_[entry.cone.cell].left_above : cells_[entry.cone.cell].right_above;
      const bool stands = entry.from == none || other.from == none;
      const Cone& upper = entry.from == above ? entry.cone : other.cone;
      const Cone& lower = entry.from == above ? other.cone : entry.cone;
      entry.cone.upper = stands ? none : upper.upper;
      entry.cone.lower = stands ? none : lower.lower;
      if (stands) entry.from = none;
    }
    return entry.cone;
  }

 private:
  struct Entry {
    std::uint32_t key;
    std::uint32_t from;
    Cone cone;
    bool operator<(const Entry& o) const {
      return key != o.key ? key > o.key : cone.cell > o.cone.cell;
    }
  };
  /// Neighbours have a smaller one.
  std::uint32_t key(std::uint32_t cell) const {
    const std::uint32_t begin = rightwards ? cells_[cell].left : cells_[cell].right;
    if (begin == none) return 0;
    return rightwards ? begin + 1 : none - begin;
  }
  Entry take() {
    std::pop_heap(open_.begin(), open_.end());
    const Entry entry = open_.back();
    open_.pop_back();
    return entry;
  }

  std::span<const Cell> cells_;
  std::vector<Entry> open_;
};

/// Looks through every cell once: from a disc, cones through different cells overlap, so that the
/// same cell would be looked through for many of them.
template <bool rightwards, class OnPoint, class OnSegments>
void Trapezoids::look_once(const FromDisc& source, const Cones& starts, OnPoint& point,
                           OnSegments& segments) const {
  Front<rightwards> front(cells_);
  for (const Cone& cone : starts) front.push(cone, none);
  while (!front.empty()) {
    const Cone cone = front.pop();
    look_through<rightwards>(cone, source, point, segments,
                             [&](const Cone& next) { front.push(next, cone.cell); });
  }
}

/// A look around from a place, as far as ways to a goal may lead.
class Trapezoids::Look {
 public:
  void begin(const Trapezoids& cells, Vec2 from, Vec2 to);
  /// Length of the shortest way to the goal that may lead over something not looked at yet;
  /// infinity if there is nothing more.
  double left() const { return left_; }
  /// Looks at all that ways of up to this length may lead over, and at some more.
  template <class OnPoint, class OnSegments>
  void go_on(double length, OnPoint&& point, OnSegments&& segments);

 private:
  struct Beyond {
    Cone cone;
    bool rightwards;
    double length;
  };
  double length_over(const Cone& cone, bool rightwards) const;
  template <bool rightwards, class OnPoint, class OnSegments>
  void look(const Cone& start, double length, OnPoint& point, OnSegments& segments);

  const Trapezoids* cells_ = nullptr;
  FromPoint source_{};
  Vec2 to_;
  double left_ = 0;
  std::vector<Beyond> beyond_;
  std::vector<Beyond> next_;  // reused
  Cones cones_;               // reused
};

template <bool rightwards, class OnPoint, class OnSegments>
void Trapezoids::Look::look(const Cone& start, double length, OnPoint& point,
                            OnSegments& segments) {
  cones_.push_back(start);
  while (!cones_.empty()) {
    const Cone cone = cones_.back();
    cones_.pop_back();
    cells_->look_through<rightwards>(cone, source_, point, segments, [&](const Cone& next) {
      const double over = length_over(next, rightwards);
      if (over <= length)
        cones_.push_back(next);
      else
        next_.push_back({next, rightwards, over});
    });
  }
}

template <class OnPoint, class OnSegments>
void Trapezoids::Look::go_on(double length, OnPoint&& point, OnSegments&& segments) {
  next_.clear();
  for (const Beyond& one : beyond_) {
    if (one.length > length)
      next_.push_back(one);
    else if (one.rightwards)
      look<true>(one.cone, length, point, segments);
    else
      look<false>(one.cone, length, point, segments);
  }
  beyond_.swap(next_);
  left_ = std::numeric_limits<double>::infinity();
  for (const Beyond& one : beyond_) left_ = std::min(left_, one.length);
}

template <class OnPoint, class OnSegments>
void Trapezoids::look_around(Vec2 from, OnPoint&& point, OnSegments&& segments) const {
  Cones cones;
  cones.reserve(64);
  const FromPoint source{from};
  if (const std::uint32_t number = point_at(from); number != none) {
    for (std::uint32_t i = first_right_of_[number]; i < first_right_of_[number + 1]; ++i)
      cones.push_back({i, none, none});
    look<true>(source, cones, point, segments);
    for (std::uint32_t i = first_left_of_[number]; i < first_left_of_[number + 1]; ++i)
      cones.push_back({ends_[i], none, none});
    return look<false>(source, cones, point, segments);
  }
  const Cone all{cell_at(from), none, none};
  cones.push_back(all);
  look<true>(source, cones, point, segments);
  cones.push_back(all);
  look<false>(source, cones, point, segments);
}

template <class OnPoint, class OnSegments>
void Trapezoids::look_around(const Disc& from, std::span<const std::uint32_t, 4> inscribed,
                             OnPoint&& point, OnSegments&& segments) const {
  Cones starts;
  start_around(inscribed, starts);
  look_once<true>(FromDisc{from}, starts, point, segments);
  look_once<false>(FromDisc{from}, starts, point, segments);
}

}  // namespace microswarm
