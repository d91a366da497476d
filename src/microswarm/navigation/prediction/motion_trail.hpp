// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/prediction/motion_trail_tuning.hpp"

namespace microswarm::navigation {

/// State of a body at one time.
struct TrailPoint {
  double t = 0;       ///< [s]
  Vec2 position{};    ///< centre [µm]
  Vec2 velocity{};    ///< [µm/s]
  double radius = 0;  ///< [µm]
  double turn = 0;    ///< rotation since first seen [rad]
};

/// Past time at which the state was like the current one. The motion after it is expected to repeat
/// or, if the body passed in the opposite direction, the motion before it.
struct Recurrence {
  double t = 0;           ///< time [s]
  bool reversed = false;  ///< whether it passed in the opposite direction
};

/// History of a body over `memory` seconds, at most max_points frames. Does not allocate after
/// construction.
class MotionTrail {
 public:
  static constexpr std::size_t max_points = 1200;  ///< size of the buffer; `memory` shapes it

  MotionTrail() { points_.reserve(max_points); }

  /// Adds a point later than all others.
  void add(const TrailPoint& point, double memory);
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }
  std::size_t size() const { return points_.size(); }
  const TrailPoint& back() const { return points_.back(); }
  const std::vector<TrailPoint>& points() const { return points_; }

  /// State at time `t` [s], interpolated smoothly between points, extrapolated straight outside.
  TrailPoint at(double t) const;

  /// Past time most similar to the newest point, which was seen with the `noise` [µm]. Nothing if
  /// the body was never close to this position and velocity, or is at rest.
  std::optional<Recurrence> recurrence(double noise, const RecurrenceTuning& tuning = {}) const;
  /// Past point that corresponds to `s` seconds after the newest point, given the recurrence. A
  /// recurrence in the same direction repeats periodically.
  TrailPoint after(const Recurrence& recurrence, double s) const;

 private:
  std::vector<TrailPoint> points_;
};

}  // namespace microswarm::navigation
