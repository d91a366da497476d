// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "microswarm/geometry/shapes.hpp"

namespace microswarm {

/// Rays that touch a circle and keep a distance from the ends of segments.
struct Rays {
  Vec2 centre{};
  double offset = 0;  ///< of the centre to the left of a ray [µm]: the radius; negative: to the
                      ///< right; 0: they begin at the centre
  double keep = 0;    ///< the distance [µm], at most the radius if there is one
};

/// On which sides of a ray something may be that it passes closely.
struct Sides {
  bool left = true, right = true;
};

/// Directions of the rays that are still open. A direction is a number that grows with its angle,
/// from −2 to 2. A limit by an end that was passed holds for what is some way farther on: nearer
/// by, a ray may have come to its own end before it comes past the other.
class RayBounds {
 public:
  /// Bounds of rays that pass an end: the lowest direction above it, the highest one below it, and
  /// how closely rays of these directions pass it.
  struct Limits {
    double above = -infinite, below = infinite;
    double doubt2 = 0;  ///< squared
    bool exist = false;
  };

  /// Applies the pending bounds at x.
  void reach(double x) {
    if (x >= lower_from_) lower_ = std::max(lower_, std::exchange(next_lower_, -infinite));
    if (x >= upper_from_) upper_ = std::min(upper_, std::exchange(next_upper_, infinite));
  }
  void pass_above(const Limits& end, double from) {
    if (end.above > next_lower_) next_lower_ = end.above, lower_from_ = from;
  }
  void pass_below(const Limits& end, double from) {
    if (end.below < next_upper_) next_upper_ = end.below, upper_from_ = from;
  }
  /// Excludes rays that point back.
  void only_forward() {
    lower_ = std::max(lower_, -1.0);
    upper_ = std::min(upper_, 1.0);
  }
  /// Bounds by the distance kept on the wrong side of the end, for rays that do not point back.
  void pass_nearly_above(const Limits& end) {
    if (end.exist) lower_ = std::max(lower_, end.below);
  }
  void pass_nearly_below(const Limits& end) {
    if (end.exist) upper_ = std::min(upper_, end.above);
  }
  bool hold(double direction, double doubt2) const {
    const double beyond = std::max(lower_ - direction, direction - upper_) - same_ray;
    return beyond <= 0 || beyond * beyond <= doubt2;
  }
  bool are_empty() const { return lower_ > upper_ + same_ray; }
  bool begin_before(const RayBounds& o) const { return lower_ < o.lower_; }
  bool overlap(const RayBounds& above) const { return above.lower_ <= upper_; }
  /// Both, and what is between them.
  void join(const RayBounds& o) {
    lower_ = std::min(lower_, o.lower_);
    upper_ = std::max(upper_, o.upper_);
    next_lower_ = std::min(next_lower_, o.next_lower_);
    next_upper_ = std::max(next_upper_, o.next_upper_);
    lower_from_ = std::max(lower_from_, o.lower_from_);
    upper_from_ = std::max(upper_from_, o.upper_from_);
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr double same_ray = 1e-9;

  double lower_ = -infinite, upper_ = infinite;
  double next_lower_ = -infinite, next_upper_ = infinite;
  double lower_from_ = -infinite, upper_from_ = -infinite;
};

/// Rays to one side, seen so that they go to the right.
template <bool rightwards>
class RayView {
 public:
  using Limits = RayBounds::Limits;

  explicit RayView(const Rays& rays)
      : rays_(rays),
        offset_(rightwards ? rays.offset : -rays.offset),
        keep_((1 - share) * rays.keep),
        doubt_(4 * share * (std::abs(rays.offset) + rays.keep)) {
    const double inside = (1 - share) * std::max(0.0, std::abs(rays.offset) - rays.keep);
    inside2_ = inside * inside;
  }

  double position_along(Vec2 p) const { return rightwards ? p.x : -p.x; }
  /// From where on a limit by this end holds.
  double holds_from(Vec2 p) const { return position_along(p) + 3 * rays_.keep; }
  /// Whether so far on nothing is seen by rays that go back. Such a ray comes from the disc, and
  /// what it passes closely at its end is less far back than the disc.
  bool goes_on(Vec2 p) const {
    return position_along(p) >=
           position_along(rays_.centre) + std::abs(rays_.offset) + 2 * rays_.keep;
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
            .exist = true};
  }
  /// Sides of an end: above a ray is its left, or its right if the rays point to the left.
  Sides sides(const Limits& end, const RayBounds& bounds) const {
    if (!end.exist) return {true, true};
    const bool is_above = bounds.hold(end.below, end.doubt2);
    const bool is_below = bounds.hold(end.above, end.doubt2);
    return rightwards ? Sides{is_above, is_below} : Sides{is_below, is_above};
  }
  Sides sides(const Disc& disc, const RayBounds& bounds) const {
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
  double offset_;
  double keep_;
  double doubt_;
  double inside2_;
};

}  // namespace microswarm
