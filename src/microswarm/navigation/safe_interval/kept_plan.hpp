// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/safe_interval/obstacle_forecast.hpp"
#include "microswarm/planning/space_time/safe_interval_search.hpp"

namespace microswarm::navigation {

/// A plan in space and time that is kept from step to step: straight legs, each of which may have
/// to wait for its departure. A leg without a length is a stay until then. Does not allocate after
/// construction for plans of up to max_legs.
class KeptPlan {
 public:
  static constexpr std::size_t max_legs = 512;

  struct Leg {
    Vec2 end{};                 ///< [µm]
    double depart = -infinity;  ///< not before this time [s]
  };

  /// `speed` [µm/s].
  explicit KeptPlan(double speed, const planning::TurnFirst& turning = {})
      : speed_(speed), turning_(turning) {
    legs_.reserve(max_legs);
  }

  void clear() {
    legs_.clear();
    next_ = 0;
  }
  bool empty() const { return next_ >= legs_.size(); }
  /// Takes a path whose times are relative to `begin` [s] and whose first point is the swarm's;
  /// `left` is the time to the goal from its end [s].
  void adopt(std::span<const planning::TimedPoint> path, double begin, double left);
  /// Appends a leg without a wait.
  void append(Vec2 end) { legs_.push_back({end, -infinity}); }
  /// Continues with the next leg at `now` [s] when the swarm is within `reach` [µm] of the end of
  /// one or has passed it, and a stay is over.
  void advance(Vec2 position, double reach, double now);
  /// Leaves out the current leg and its wait: the next one departs at once from `from`.
  void cut(Vec2 from) {
    legs_[++next_].depart = -infinity;
    from_ = from;
  }

  /// The current leg, and the one after it; null if there is none.
  const Leg& leg() const { return legs_[next_]; }
  const Leg* next_leg() const { return next_ + 1 < legs_.size() ? &legs_[next_ + 1] : nullptr; }
  bool is_last() const { return next_ + 1 == legs_.size(); }
  /// Whether the current leg is a stay.
  bool is_stay() const { return !empty() && leg().end == from_; }
  /// Whether the last leg is a stay.
  bool ends_in_stay() const {
    if (empty()) return false;
    return legs_.back().end == (is_last() ? from_ : legs_[legs_.size() - 2].end);
  }
  /// Remaining legs.
  std::span<const Leg> legs() const { return std::span(legs_).subspan(next_); }
  /// Time that the swarm has still to wait at `now` [s].
  double wait(double now) const { return empty() ? 0 : std::max(0.0, leg().depart - now); }
  /// Time until the end of the path for a swarm with `pose` at `now` [s].
  double duration(const Pose2& pose, double now) const;
  /// Time to the goal from the end of the path [s].
  double left() const { return left_; }

  /// Time from `now` [s] until the swarm has less than `share` of a body's gap; infinity if that
  /// does not happen during the first `samples` samples of the forecast. A gap that is too small
  /// already must grow at `recovery` [µm/s].
  double conflict(const Pose2& pose, double now, const ObstacleForecast& forecast, int samples,
                  double radius, double share, double recovery) const;

 private:
  void skip() { from_ = legs_[next_++].end; }

  double turn_delay(const Leg& leg, Vec2 from, double& course) const;

  double speed_;
  planning::TurnFirst turning_;
  std::vector<Leg> legs_;
  std::size_t next_ = 0;
  Vec2 from_;  ///< begin of the current leg
  double left_ = 0;
};

}  // namespace microswarm::navigation
