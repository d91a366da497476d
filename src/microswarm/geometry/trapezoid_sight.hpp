// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "microswarm/geometry/predicates.hpp"
#include "microswarm/geometry/ray_view.hpp"
#include "microswarm/geometry/trapezoids.hpp"

namespace microswarm {

/// Views through the cells of a decomposition, which must outlive it. Both functions call
/// point(number, sides) for every end of a segment that a ray may pass closely, and
/// cell(number, find_sides) for every cell that a ray passes, for some repeatedly. find_sides(disc)
/// returns the sides on which a disc in the cell may be passed closely. Rays that differ by less
/// than 1e-9 rad are the same.
class TrapezoidSight {
 public:
  static constexpr std::uint32_t none = Trapezoids::none;

  explicit TrapezoidSight(const Trapezoids& cells) : cells_(&cells) {}

  /// Along the rays from a point or an end of segments, with nothing else in their circle.
  template <class OnPoint, class OnCell>
  void look_around(const Rays& rays, OnPoint&& point, OnCell&& on_cell) const;
  /// Along the rays from a disc, which lies in `cells`; the circle is `keep` around it.
  template <class OnPoint, class OnCell>
  void look_around(const Rays& rays, std::span<const std::uint32_t> cells, OnPoint&& point,
                   OnCell&& on_cell) const;

 private:
  friend class TrapezoidLook;

  /// Visible part of a cell from a point: the directions between those to two points.
  struct Cone {
    std::uint32_t cell;
    std::uint32_t lower = none;  ///< point; none: straight down
    std::uint32_t upper = none;
  };
  struct Beam;
  template <bool rightwards>
  class Front;
  template <bool rightwards>
  class PlaceView;

  template <bool rightwards, class OnPoint, class OnCell, class Push>
  void look_through(const Cone& cone, const PlaceView<rightwards>& view, OnPoint& point,
                    OnCell& on_cell, Push&& push) const;
  template <bool rightwards, class OnPoint, class OnCell, class Push>
  void look_through(const Beam& beam, const RayView<rightwards>& view, OnPoint& point,
                    OnCell& on_cell, Push&& push) const;
  template <bool rightwards, class OnPoint, class OnCell>
  void look(const Rays& rays, std::vector<Cone>& cones, OnPoint& point, OnCell& on_cell) const;
  template <bool rightwards, class OnPoint, class OnCell>
  void look_from(const Rays& rays, std::span<const std::uint32_t> cells, OnPoint& point,
                 OnCell& on_cell) const;

  const Trapezoids* cells_;
};

/// Visible part of a cell from a disc: the rays within the bounds.
struct TrapezoidSight::Beam {
  std::uint32_t cell;
  bool goes_back = false;  ///< some of its rays, as far as they are seen
  RayBounds bounds = {};
};

/// Rays from a place, or from the circle around an end of segments. What is seen from there is
/// known exactly; the rays come by what limits it.
template <bool rightwards>
class TrapezoidSight::PlaceView {
 public:
  PlaceView(const Trapezoids& cells, const Rays& rays)
      : cells_(cells),
        view_(rays),
        rays_(rays),
        turn_((rightwards ? 1.0 : -1.0) * ((rays.offset > 0) - (rays.offset < 0))),
        width_((1 - 1e-6) * (turn_ == 0 ? rays.keep : 2 * rays.keep)) {}

  /// Whether p is above (+1) or below (−1) the line through a point. Exact.
  int side(std::uint32_t point, Vec2 p) const {
    const int side = orientation(rays_.centre, cells_.points()[point], p);
    return rightwards ? side : -side;
  }
  /// Whether no ray comes through between the two points and gets farther than `at`.
  bool is_closed(const Cone& cone, Vec2 at) const {
    if (!holds(cone.lower, at) || !holds(cone.upper, at)) return false;
    return are_too_near(off(cone.lower), off(cone.upper));
  }
  /// Sides of rays through the cone on which an end may be.
  Sides sides(const Cone& cone, Vec2 p) const {
    const Vec2 there = off(p);
    const bool is_above = !holds(cone.lower, p) || !are_too_near(off(cone.lower), there);
    const bool is_below = !holds(cone.upper, p) || !are_too_near(there, off(cone.upper));
    return rightwards ? Sides{is_above, is_below} : Sides{is_below, is_above};
  }
  Sides sides(const Cone& cone, const Disc& disc) const {
    RayBounds bounds;
    const Trapezoids::Cell& cell = cells_.cells()[cone.cell];
    if (const std::uint32_t begin = rightwards ? cell.left : cell.right; begin != none) {
      const Vec2 at = cells_.points()[begin];
      if (holds(cone.lower, at))
        bounds.pass_above(view_.limits(cells_.points()[cone.lower]), view_.position_along(at));
      if (holds(cone.upper, at))
        bounds.pass_below(view_.limits(cells_.points()[cone.upper]), view_.position_along(at));
      bounds.reach(view_.position_along(at));
    }
    return view_.sides(disc, bounds);
  }

 private:
  Vec2 off(Vec2 p) const {
    const Vec2 off = p - rays_.centre;
    return rightwards ? off : Vec2{-off.x, off.y};
  }
  Vec2 off(std::uint32_t point) const { return off(cells_.points()[point]); }
  bool holds(std::uint32_t point, Vec2 at) const {
    return point != none && view_.position_along(at) >= view_.holds_from(cells_.points()[point]);
  }
  /// Whether the angle from a point up to another is less than that at which the width is seen: of
  /// the strip of a ray that has the lower one to its right, and the upper one, or else what the
  /// ray goes around, to its left.
  bool are_too_near(Vec2 lower, Vec2 upper) const {
    if (dot(lower, upper) <= 0) return false;
    const double apart = std::max(0.0, cross(lower, upper));
    double farther2 = turn_ > 0 ? squared_norm(upper) : squared_norm(lower);
    if (turn_ == 0) farther2 = std::max(squared_norm(upper), farther2);
    return apart * apart < width_ * width_ * farther2;
  }

  const Trapezoids& cells_;
  RayView<rightwards> view_;
  Rays rays_;
  double turn_;  ///< of the rays around the circle: 1 counter-clockwise, 0 without one
  double width_;
};

/// Looks through one cell, and calls push(cone) for the cells beyond.
template <bool rightwards, class OnPoint, class OnCell, class Push>
void TrapezoidSight::look_through(const Cone& cone, const PlaceView<rightwards>& view,
                                  OnPoint& point, OnCell& on_cell, Push&& push) const {
  on_cell(cone.cell, [&](const Disc& disc) { return view.sides(cone, disc); });
  const Trapezoids::Cell& cell = cells_->cells()[cone.cell];
  const std::uint32_t end = rightwards ? cell.right : cell.left;
  if (end == none) return;
  const Vec2 p = cells_->points()[end];
  int over = 1, under = 1;
  if (cone.lower != none) over = view.side(cone.lower, p);
  if (cone.upper != none) under = -view.side(cone.upper, p);
  if (over >= 0 && under >= 0)
    if (const Sides sides = view.sides(cone, p); sides.left || sides.right) point(end, sides);
  const std::uint32_t below = rightwards ? cell.right_below : cell.left_below;
  const std::uint32_t above = rightwards ? cell.right_above : cell.left_above;
  const auto push_open = [&](const Cone& next) {
    if (!view.is_closed(next, p)) push(next);
  };
  if (below != none && over > 0) push_open({below, cone.lower, under > 0 ? end : cone.upper});
  if (above != none && under > 0) push_open({above, over > 0 ? end : cone.lower, cone.upper});
}

/// The same for a beam.
template <bool rightwards, class OnPoint, class OnCell, class Push>
void TrapezoidSight::look_through(const Beam& beam, const RayView<rightwards>& view, OnPoint& point,
                                  OnCell& on_cell, Push&& push) const {
  on_cell(beam.cell, [&](const Disc& disc) { return view.sides(disc, beam.bounds); });
  const Trapezoids::Cell& cell = cells_->cells()[beam.cell];
  const std::uint32_t end = rightwards ? cell.right : cell.left;
  if (end == none) return;
  const Vec2 p = cells_->points()[end];
  const RayBounds::Limits limits = view.limits(p);
  RayBounds bounds = beam.bounds;
  bounds.reach(view.position_along(p));
  if (const Sides sides = view.sides(limits, bounds); sides.left || sides.right) point(end, sides);
  if (beam.goes_back && view.goes_on(p)) return;
  const std::uint32_t below = rightwards ? cell.right_below : cell.left_below;
  const std::uint32_t above = rightwards ? cell.right_above : cell.left_above;
  if (below != none) {
    Beam next{below, beam.goes_back, bounds};
    if (!beam.goes_back) next.bounds.pass_nearly_below(limits);
    next.bounds.pass_below(limits, view.holds_from(p));
    if (!next.bounds.are_empty()) push(next);
  }
  if (above != none) {
    Beam next{above, beam.goes_back, bounds};
    if (!beam.goes_back) next.bounds.pass_nearly_above(limits);
    next.bounds.pass_above(limits, view.holds_from(p));
    if (!next.bounds.are_empty()) push(next);
  }
}

template <bool rightwards, class OnPoint, class OnCell>
void TrapezoidSight::look(const Rays& rays, std::vector<Cone>& cones, OnPoint& point,
                          OnCell& on_cell) const {
  const PlaceView<rightwards> view(*cells_, rays);
  while (!cones.empty()) {
    const Cone cone = cones.back();
    cones.pop_back();
    look_through(cone, view, point, on_cell, [&](const Cone& next) { cones.push_back(next); });
  }
}

/// Cells that are to be looked through, from the nearest on.
template <bool rightwards>
class TrapezoidSight::Front {
 public:
  explicit Front(std::span<const Trapezoids::Cell> cells) : cells_(cells) {}
  bool empty() const { return open_.empty(); }
  void push(const Beam& beam) {
    open_.push_back({key(beam.cell), beam});
    std::push_heap(open_.begin(), open_.end());
  }
  /// The next cell: its beams from below, those that overlap as one.
  void pop(std::vector<Beam>& beams) {
    beams.clear();
    do {
      std::pop_heap(open_.begin(), open_.end());
      const Beam next = open_.back().beam;
      open_.pop_back();
      if (!beams.empty() && beams.back().goes_back == next.goes_back &&
          beams.back().bounds.overlap(next.bounds))
        beams.back().bounds.join(next.bounds);
      else
        beams.push_back(next);
    } while (!open_.empty() && open_.front().beam.cell == beams.back().cell);
  }

 private:
  struct Entry {
    std::uint32_t key;
    Beam beam;
    bool operator<(const Entry& o) const {
      if (key != o.key) return key > o.key;
      if (beam.cell != o.beam.cell) return beam.cell > o.beam.cell;
      if (beam.goes_back != o.beam.goes_back) return o.beam.goes_back;
      return o.beam.bounds.begin_before(beam.bounds);
    }
  };
  /// Neighbours have a smaller one.
  std::uint32_t key(std::uint32_t cell) const {
    const std::uint32_t begin = rightwards ? cells_[cell].left : cells_[cell].right;
    if (begin == none) return 0;
    return rightwards ? begin + 1 : none - begin;
  }

  std::span<const Trapezoids::Cell> cells_;
  std::vector<Entry> open_;
};

/// From a disc, beams that begin in different cells overlap.
template <bool rightwards, class OnPoint, class OnCell>
void TrapezoidSight::look_from(const Rays& rays, std::span<const std::uint32_t> cells,
                               OnPoint& point, OnCell& on_cell) const {
  const RayView<rightwards> view(rays);
  Front<rightwards> front(cells_->cells());
  RayBounds ahead;
  ahead.only_forward();
  for (const std::uint32_t cell : cells) {
    front.push({cell, false, ahead});
    front.push({cell, true, {}});
  }
  for (std::vector<Beam> beams; !front.empty();) {
    front.pop(beams);
    for (const Beam& beam : beams)
      look_through(beam, view, point, on_cell, [&](const Beam& next) { front.push(next); });
  }
}

template <class OnPoint, class OnCell>
void TrapezoidSight::look_around(const Rays& rays, OnPoint&& point, OnCell&& on_cell) const {
  std::vector<Cone> cones;
  cones.reserve(64);
  if (const std::uint32_t number = cells_->point_at(rays.centre); number != none) {
    const auto [first, last] = cells_->cells_right_of(number);
    for (std::uint32_t cell = first; cell < last; ++cell) cones.push_back({cell});
    look<true>(rays, cones, point, on_cell);
    for (const std::uint32_t cell : cells_->cells_left_of(number)) cones.push_back({cell});
    return look<false>(rays, cones, point, on_cell);
  }
  const Cone all{cells_->cell_at(rays.centre)};
  cones.push_back(all);
  look<true>(rays, cones, point, on_cell);
  cones.push_back(all);
  look<false>(rays, cones, point, on_cell);
}

template <class OnPoint, class OnCell>
void TrapezoidSight::look_around(const Rays& rays, std::span<const std::uint32_t> cells,
                                 OnPoint&& point, OnCell&& on_cell) const {
  look_from<true>(rays, cells, point, on_cell);
  look_from<false>(rays, cells, point, on_cell);
}

/// View from a point, step by step: what is near the way to a goal first.
class TrapezoidLook {
 public:
  /// Paths keep `keep` [µm] from the segments and may end as far from what they lead to.
  void begin(const Trapezoids& cells, Vec2 from, Vec2 to, double keep);
  /// Lower bound of the length of a path to the goal over something not looked at yet; infinity if
  /// there is nothing more.
  double left() const { return left_; }
  /// Looks at all that paths of up to this length may lead over, and at some more.
  template <class OnPoint, class OnCell>
  void go_on(double length, OnPoint&& point, OnCell&& on_cell);

 private:
  using Cone = TrapezoidSight::Cone;
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
  std::vector<Cone> cones_;   // reused
};

template <bool rightwards, class OnPoint, class OnCell>
void TrapezoidLook::look(const Cone& start, double length, OnPoint& point, OnCell& on_cell) {
  const TrapezoidSight::PlaceView<rightwards> view(*cells_, rays_);
  cones_.push_back(start);
  while (!cones_.empty()) {
    const Cone cone = cones_.back();
    cones_.pop_back();
    TrapezoidSight(*cells_).look_through(cone, view, point, on_cell, [&](const Cone& next) {
      const double over = length_over(next, rightwards);
      if (over <= length)
        cones_.push_back(next);
      else
        next_.push_back({next, rightwards, over});
    });
  }
}

template <class OnPoint, class OnCell>
void TrapezoidLook::go_on(double length, OnPoint&& point, OnCell&& on_cell) {
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

}  // namespace microswarm
