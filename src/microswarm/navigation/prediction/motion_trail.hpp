// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Where a body was at a time, and how it moved there.
struct TrailPoint {
  double t = 0;       ///< [s]
  Vec2 place;         ///< of its centre [µm]
  Vec2 velocity;      ///< [µm/s]
  double radius = 0;  ///< [µm]
  double turn = 0;    ///< since it was first seen [rad]
};

/// A moment of the past that was like the present: what came after it is expected again, or, when
/// the body passed in the other direction, what came before it.
struct Recurrence {
  double t = 0;           ///< when [s]
  bool reversed = false;  ///< did it pass in the other direction?
};

/// Where a body was as long as it is remembered: `memory` seconds, and at most so many frames as
/// the trail was made for. Allocates nothing after it is made.
class MotionTrail {
 public:
  static constexpr std::size_t max_points = 1200;

  MotionTrail() { points_.reserve(max_points); }

  /// Later than all before.
  void add(const TrailPoint& point, double memory);
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }
  std::size_t size() const { return points_.size(); }
  const TrailPoint& back() const { return points_.back(); }
  const std::vector<TrailPoint>& points() const { return points_; }

  /// Smoothly between the points, straight on before the first and after the last of them.
  TrailPoint at(double t) const;

  /// The moment most like the newest point, which was seen with the `noise` [µm]; none when it was
  /// never nearly there and nearly as fast, or rests.
  std::optional<Recurrence> recurrence(double noise) const;
  /// What followed the recurrence `s` seconds later. One in the same direction goes round and
  /// round.
  TrailPoint after(const Recurrence& recurrence, double s) const;

 private:
  std::vector<TrailPoint> points_;
};

}  // namespace microswarm
