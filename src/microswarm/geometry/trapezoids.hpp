// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
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

  /// Rays that touch a circle and keep a distance from the ends of all segments.
  struct Rays {
    Vec2 centre;
    double offset = 0;  ///< of the centre to the left of a ray [µm]: the radius; negative: to the
                        ///< right; 0: they begin at the centre
    double keep = 0;    ///< the distance [µm], at most the radius if there is one
  };

  /// On which sides of a ray something may be that it passes closely.
  struct Sides {
    bool left = true, right = true;
  };

  /// Looks along the rays from a place or an end of segments, with a circle in which there is
  /// nothing else: calls point(number, sides) for every end that may be passed closely, and
  /// cell(number, sides_of) for every cell that is passed, for some repeatedly. sides_of(disc)
  /// tells on which sides a disc in the cell may be passed closely. Rays that differ by less than
  /// 1e-9 rad are the same.
  template <class OnPoint, class OnCell>
  void look_around(const Rays& rays, OnPoint&& point, OnCell&& on_cell) const;
  /// The same step by step, what is near the way to a goal first.
  class Look;
  /// The same from a disc, which is in `cells`; the circle is `keep` around it.
  template <class OnPoint, class OnCell>
  void look_around(const Rays& rays, std::span<const std::uint32_t> cells, OnPoint&& point,
                   OnCell&& on_cell) const;
  /// The cells that touch a quadrilateral of segments from outside, given the numbers of its
  /// corners, from left to right.
  std::vector<std::uint32_t> cells_around(std::span<const std::uint32_t, 4> quadrilateral) const;
  /// A box around a cell; infinite where the cell is.
  Box bounding_box(std::uint32_t cell) const;

 private:
  class Sweep;

  class Bounds;
  /// What is seen in a cell: from a place between the directions to two points, and there the rays
  /// within the bounds.
  struct Cone;
  using Cones = std::vector<Cone>;
  /// Cells that are to be looked through, from the nearest on.
  template <bool rightwards>
  class Front;
  template <bool rightwards>
  class View;
  static constexpr double same_ray = 1e-9;

  template <bool rightwards, class OnPoint, class OnCell, class Push>
  void look_through(const Cone& cone, const View<rightwards>& view, OnPoint& point, OnCell& on_cell,
                    Push&& push) const;
  template <bool rightwards, class OnPoint, class OnCell>
  void look(const Rays& rays, Cones& cones, OnPoint& point, OnCell& on_cell) const;
  template <bool rightwards, class OnPoint, class OnCell>
  void look_from(const Rays& rays, std::span<const std::uint32_t> cells, OnPoint& point,
                 OnCell& on_cell) const;

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

/// Directions of the rays that are still open. A direction is a number that grows with its angle,
/// from −2 to 2. A limit by an end that was passed holds for what is some way farther on: nearer
/// by, a ray may have come to its own end before it comes past the other.
class Trapezoids::Bounds {
 public:
  /// Of rays that pass an end: the least direction above it, the most below it, and how closely
  /// those pass it that have these directions.
  struct Limits {
    double above = -infinite, below = infinite;
    double doubt2 = 0;  ///< squared
    bool limits = false;
  };

  /// At x.
  void reach(double x) {
    if (x >= least_from_) least_ = std::max(least_, std::exchange(next_least_, -infinite));
    if (x >= most_from_) most_ = std::min(most_, std::exchange(next_most_, infinite));
  }
  void pass_above(const Limits& end, double from) {
    if (end.above > next_least_) next_least_ = end.above, least_from_ = from;
  }
  void pass_below(const Limits& end, double from) {
    if (end.below < next_most_) next_most_ = end.below, most_from_ = from;
  }
  /// Leaves out what goes back.
  void go_on() {
    least_ = std::max(least_, -1.0);
    most_ = std::min(most_, 1.0);
  }
  /// By the distance that is kept on the wrong side of the end. Holds for rays that do not go back.
  void pass_nearly_above(const Limits& end) {
    if (end.limits) least_ = std::max(least_, end.below);
  }
  void pass_nearly_below(const Limits& end) {
    if (end.limits) most_ = std::min(most_, end.above);
  }
  bool hold(double direction, double doubt2) const {
    const double beyond = std::max(least_ - direction, direction - most_) - same_ray;
    return beyond <= 0 || beyond * beyond <= doubt2;
  }
  bool are_empty() const { return least_ > most_ + same_ray; }
  bool begin_before(const Bounds& o) const { return least_ < o.least_; }
  bool overlap(const Bounds& above) const { return above.least_ <= most_; }
  /// Both, and what is between them.
  void join(const Bounds& o) {
    least_ = std::min(least_, o.least_);
    most_ = std::max(most_, o.most_);
    next_least_ = std::min(next_least_, o.next_least_);
    next_most_ = std::max(next_most_, o.next_most_);
    least_from_ = std::max(least_from_, o.least_from_);
    most_from_ = std::max(most_from_, o.most_from_);
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  double least_ = -infinite, most_ = infinite;
  double next_least_ = -infinite, next_most_ = infinite;
  double least_from_ = -infinite, most_from_ = -infinite;
};

struct Trapezoids::Cone {
  std::uint32_t cell;
  std::uint32_t lower = none;  ///< point; none: straight down
  std::uint32_t upper = none;
  Bounds bounds = {};
};

/// Rays to one side, seen so that they go to the right.
template <bool rightwards>
class Trapezoids::View {
 public:
  using Limits = Bounds::Limits;

  View(const Rays& rays, bool from_disc)
      : rays_(rays),
        from_disc_(from_disc),
        offset_(rightwards ? rays.offset : -rays.offset),
        keep_((1 - share) * rays.keep),
        doubt_(4 * share * (std::abs(rays.offset) + rays.keep)) {
    const double inside = (1 - share) * std::max(0.0, std::abs(rays.offset) - rays.keep);
    inside2_ = inside * inside;
  }

  bool from_disc() const { return from_disc_; }
  double place_of(Vec2 p) const { return rightwards ? p.x : -p.x; }
  /// From where on a limit by this end holds.
  double holds_from(Vec2 p) const { return place_of(p) + 3 * rays_.keep; }
  /// Whether so far on nothing is seen by rays that go back. Such a ray comes from the disc, and
  /// what it passes closely at its end is less far back than the disc.
  bool goes_on(Vec2 p) const {
    return place_of(p) >= place_of(rays_.centre) + std::abs(rays_.offset) + 2 * rays_.keep;
  }
  /// Whether p is above (+1) or below (−1) the line from the place through q. Exact.
  int side(Vec2 q, Vec2 p) const {
    const int side = orientation(rays_.centre, q, p);
    return rightwards ? side : -side;
  }
  Limits limits(Vec2 p, double radius = 0) const {
    Vec2 off = p - rays_.centre;
    if (!rightwards) off.x = -off.x;
    const double apart2 = squared_norm(off);
    // What is in the disc limits nothing.
    if (apart2 <= inside2_) return {};
    const double least = radius + keep_;
    return {.above = turned(off, apart2, offset_ + least),
            .below = turned(off, apart2, offset_ - least),
            .doubt2 = doubt_ / std::sqrt(apart2),
            .limits = true};
  }
  /// What is above a ray is to its left, or to its right for one who looks to the left.
  Sides sides(const Limits& end, const Bounds& bounds) const {
    if (!end.limits) return {true, true};
    const bool is_above = bounds.hold(end.below, end.doubt2);
    const bool is_below = bounds.hold(end.above, end.doubt2);
    return rightwards ? Sides{is_above, is_below} : Sides{is_below, is_above};
  }
  Sides sides(const Disc& disc, const Bounds& bounds) const {
    return sides(limits(disc.centre, disc.radius), bounds);
  }

 private:
  static constexpr double share = 1e-6;

  /// The direction to what is `off`, turned so far to the left that it passes at a distance.
  static double turned(Vec2 off, double apart2, double distance) {
    const double along2 = apart2 - distance * distance;
    const Vec2 d = along2 > 0 ? std::sqrt(along2) * off + distance * perpendicular(off)
                              : std::copysign(1.0, distance) * perpendicular(off);
    const double slope = d.y / (std::abs(d.x) + std::abs(d.y));
    if (d.x >= 0) return slope;
    return slope >= 0 ? 2 - slope : -2 - slope;
  }

  Rays rays_;
  bool from_disc_;
  double offset_;
  double keep_;
  double doubt_;
  double inside2_;
};

/// Looks through one cell, and calls push(cone) for the cells beyond.
template <bool rightwards, class OnPoint, class OnCell, class Push>
void Trapezoids::look_through(const Cone& cone, const View<rightwards>& view, OnPoint& point,
                              OnCell& on_cell, Push&& push) const {
  on_cell(cone.cell, [&](const Disc& disc) { return view.sides(disc, cone.bounds); });
  const Cell& cell = cells_[cone.cell];
  const std::uint32_t end = rightwards ? cell.right : cell.left;
  if (end == none) return;
  const Vec2 p = points_[end];
  int over = 1, under = 1;
  if (cone.lower != none) over = view.side(points_[cone.lower], p);
  if (cone.upper != none) under = -view.side(points_[cone.upper], p);
  const Bounds::Limits limits = view.limits(p);
  Bounds bounds = cone.bounds;
  bounds.reach(view.place_of(p));
  if (const Sides sides = view.sides(limits, bounds);
      over >= 0 && under >= 0 && (sides.left || sides.right))
    point(end, sides);
  const std::uint32_t below = rightwards ? cell.right_below : cell.left_below;
  const std::uint32_t above = rightwards ? cell.right_above : cell.left_above;
  const bool exact = !view.from_disc();
  const bool goes_on = !exact && view.goes_on(p);
  if (goes_on) bounds.go_on();
  if (below != none && over > 0) {
    Cone next{below, cone.lower, under > 0 && exact ? end : cone.upper, bounds};
    if (goes_on) next.bounds.pass_nearly_below(limits);
    next.bounds.pass_below(limits, view.holds_from(p));
    if (!next.bounds.are_empty()) push(next);
  }
  if (above != none && under > 0) {
    Cone next{above, over > 0 && exact ? end : cone.lower, cone.upper, bounds};
    if (goes_on) next.bounds.pass_nearly_above(limits);
    next.bounds.pass_above(limits, view.holds_from(p));
    if (!next.bounds.are_empty()) push(next);
  }
}

template <bool rightwards, class OnPoint, class OnCell>
void Trapezoids::look(const Rays& rays, Cones& cones, OnPoint& point, OnCell& on_cell) const {
  const View<rightwards> view(rays, false);
  while (!cones.empty()) {
    const Cone cone = cones.back();
    cones.pop_back();
    look_through(cone, view, point, on_cell, [&](const Cone& next) { cones.push_back(next); });
  }
}

/// Cells that are to be looked through, from the nearest on.
template <bool rightwards>
class Trapezoids::Front {
 public:
  explicit Front(std::span<const Cell> cells) : cells_(cells) {}
  bool empty() const { return open_.empty(); }
  void push(const Cone& cone) {
    open_.push_back({key(cone.cell), cone});
    std::push_heap(open_.begin(), open_.end());
  }
  /// The next cell: its cones from below, those that overlap as one.
  void pop(Cones& cones) {
    cones.clear();
    do {
      std::pop_heap(open_.begin(), open_.end());
      const Cone next = open_.back().cone;
      open_.pop_back();
      if (!cones.empty() && cones.back().bounds.overlap(next.bounds))
        cones.back().bounds.join(next.bounds);
      else
        cones.push_back(next);
    } while (!open_.empty() && open_.front().cone.cell == cones.back().cell);
  }

 private:
  struct Entry {
    std::uint32_t key;
    Cone cone;
    bool operator<(const Entry& o) const {
      if (key != o.key) return key > o.key;
      if (cone.cell != o.cone.cell) return cone.cell > o.cone.cell;
      return o.cone.bounds.begin_before(cone.bounds);
    }
  };
  /// Neighbours have a smaller one.
  std::uint32_t key(std::uint32_t cell) const {
    const std::uint32_t begin = rightwards ? cells_[cell].left : cells_[cell].right;
    if (begin == none) return 0;
    return rightwards ? begin + 1 : none - begin;
  }

  std::span<const Cell> cells_;
  std::vector<Entry> open_;
};

/// From a disc, cones that begin in different cells overlap.
template <bool rightwards, class OnPoint, class OnCell>
void Trapezoids::look_from(const Rays& rays, std::span<const std::uint32_t> cells, OnPoint& point,
                           OnCell& on_cell) const {
  const View<rightwards> view(rays, true);
  Front<rightwards> front(cells_);
  for (const std::uint32_t cell : cells) front.push({cell});
  for (Cones cones; !front.empty();) {
    front.pop(cones);
    for (const Cone& cone : cones)
      look_through(cone, view, point, on_cell, [&](const Cone& next) { front.push(next); });
  }
}

/// A look around from a place, as far as ways to a goal may lead.
class Trapezoids::Look {
 public:
  /// The ways keep `keep` [µm] from the segments and may end as far from what they lead to.
  void begin(const Trapezoids& cells, Vec2 from, Vec2 to, double keep);
  /// Length of the shortest way to the goal that may lead over something not looked at yet;
  /// infinity if there is nothing more.
  double left() const { return left_; }
  /// Looks at all that ways of up to this length may lead over, and at some more.
  template <class OnPoint, class OnCell>
  void go_on(double length, OnPoint&& point, OnCell&& on_cell);

 private:
  struct Beyond {
    Cone cone;
    bool rightwards;
    double length;
  };
  double length_over(const Cone& cone, bool rightwards) const;
  template <bool rightwards, class OnPoint, class OnCell>
  void look(const Cone& start, double length, OnPoint& point, OnCell& on_cell);

  const Trapezoids* cells_ = nullptr;
  Rays rays_;
  Vec2 to_;
  double left_ = 0;
  std::vector<Beyond> beyond_;
  std::vector<Beyond> next_;  // reused
  Cones cones_;               // reused
};

template <bool rightwards, class OnPoint, class OnCell>
void Trapezoids::Look::look(const Cone& start, double length, OnPoint& point, OnCell& on_cell) {
  const View<rightwards> view(rays_, false);
  cones_.push_back(start);
  while (!cones_.empty()) {
    const Cone cone = cones_.back();
    cones_.pop_back();
    cells_->look_through(cone, view, point, on_cell, [&](const Cone& next) {
      const double over = length_over(next, rightwards);
      if (over <= length)
        cones_.push_back(next);
      else
        next_.push_back({next, rightwards, over});
    });
  }
}

template <class OnPoint, class OnCell>
void Trapezoids::Look::go_on(double length, OnPoint&& point, OnCell&& on_cell) {
  next_.clear();
  for (const Beyond& one : beyond_) {
    if (one.length > length)
      next_.push_back(one);
    else if (one.rightwards)
      look<true>(one.cone, length, point, on_cell);
    else
      look<false>(one.cone, length, point, on_cell);
  }
  beyond_.swap(next_);
  left_ = std::numeric_limits<double>::infinity();
  for (const Beyond& one : beyond_) left_ = std::min(left_, one.length);
}

template <class OnPoint, class OnCell>
void Trapezoids::look_around(const Rays& rays, OnPoint&& point, OnCell&& on_cell) const {
  Cones cones;
  cones.reserve(64);
  if (const std::uint32_t number = point_at(rays.centre); number != none) {
    for (std::uint32_t i = first_right_of_[number]; i < first_right_of_[number + 1]; ++i)
      cones.push_back({i});
    look<true>(rays, cones, point, on_cell);
    for (std::uint32_t i = first_left_of_[number]; i < first_left_of_[number + 1]; ++i)
      cones.push_back({ends_[i]});
    return look<false>(rays, cones, point, on_cell);
  }
  const Cone all{cell_at(rays.centre)};
  cones.push_back(all);
  look<true>(rays, cones, point, on_cell);
  cones.push_back(all);
  look<false>(rays, cones, point, on_cell);
}

template <class OnPoint, class OnCell>
void Trapezoids::look_around(const Rays& rays, std::span<const std::uint32_t> cells,
                             OnPoint&& point, OnCell&& on_cell) const {
  look_from<true>(rays, cells, point, on_cell);
  look_from<false>(rays, cells, point, on_cell);
}

}  // namespace microswarm
