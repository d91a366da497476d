// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/navigation/radar/reachable_obstacles.hpp"

namespace microswarm::navigation {

/// Whether a swarm keeps the required gaps on the trajectory at these times; `before` [s] is the
/// time before the first of them.
bool is_free(const ReachableObstacles& seen, const TwoLegTrajectory& trajectory,
             std::span<const SampleTime> times, double before);

/// Minimum gap of a trajectory: the maximum of a constant and of a line in time.
struct RequiredGap {
  double start = 0;  ///< [µm]
  double rate = 0;   ///< [µm/s]
  double floor = 0;  ///< [µm]
  /// Required gap at time `t` [µm].
  double at(double t) const { return std::max(start + rate * t, floor); }
};

/// Escape trajectories that differ in one velocity only, screened together, body by body.
class EscapeFan {
 public:
  /// The trajectories of a fan: each of its velocities replaces the second of `common`, or the
  /// first one if `first_varies`.
  struct Trajectories {
    TwoLegTrajectory common{};
    bool first_varies = false;
    TwoLegTrajectory operator[](Vec2 velocity) const {
      return first_varies ? TwoLegTrajectory{velocity, common.until, common.second}
                          : TwoLegTrajectory{common.first, common.until, velocity};
    }
    /// Time at the varying velocity within the first `t` seconds [s].
    double varied_for(double t) const {
      return first_varies ? std::min(t, common.until) : std::max(0.0, t - common.until);
    }
  };
  /// Positions on all trajectories at one time, relative to a body.
  struct Positions {
    const double* x;  ///< velocities [µm/s]
    const double* y;
    std::size_t count;
    double after;          ///< time at the varying velocity [s]
    Vec2 shift{};          ///< displacement at the other velocity [µm]
    Vec2 start{}, body{};  ///< [µm]
    /// Offset of the position from the body's centre [µm].
    double off_x(std::size_t k) const { return start.x + (shift.x + after * x[k]) - body.x; }
    double off_y(std::size_t k) const { return start.y + (shift.y + after * y[k]) - body.y; }
  };

  /// `speed`: upper bound of the norm of `velocities` [µm/s].
  EscapeFan(std::vector<Vec2> velocities, double speed);

  std::span<const Vec2> velocities() const { return velocities_; }
  /// Whether, after `begin` until `until`, at least `count` of the velocities are free of contact.
  bool has_free(ReachableObstacles& seen, Vec2 begin, double until, int count);
  /// Whether has_free() is false for every first velocity within `spread` [µm/s] of `begin`. One
  /// conservative test for all of them: false if it is undecided.
  bool excludes(ReachableObstacles& seen, Vec2 begin, double spread, double until, int count);
  /// Whether some of the trajectories may keep these gaps to convex bodies at all times;
  /// is_kept() says which.
  bool may_keep(const ReachableObstacles& seen, const Trajectories& trajectories,
                std::span<const SampleTime> times, const RequiredGap& least);
  bool is_kept(std::size_t velocity) const { return blocked_[velocity] == 0; }

 private:
  /// Required gap [µm].
  struct Demand {
    double gap = 0;
    ReachableObstacles::MotionError error = ReachableObstacles::MotionError::none;
  };

  template <class GapAt>
  bool screen(const ReachableObstacles& seen, const Trajectories& trajectories,
              std::span<const SampleTime> times, ReachableObstacles::MotionError error,
              GapAt&& gap_at, std::int64_t count);
  std::int64_t screen_body(const ReachableObstacles& seen, const ReachableObstacles::NearBody& body,
                           const Trajectories& trajectories, double t, const Demand& demand);
  std::int64_t test_exactly(const Positions& at, const ReachableObstacles::NearBody& body,
                            const Demand& demand);

  std::vector<Vec2> velocities_;
  double speed_;
  std::vector<double> x_, y_;          ///< components of velocities_
  std::vector<std::int64_t> blocked_;  ///< 0 or 1 for each velocity
  std::vector<std::int64_t> undecided_;
  std::vector<std::size_t> undecided_indices_;     ///< indices of velocities
  std::vector<double> off_x_, off_y_, distances_;  ///< of the undecided velocities [µm]
  std::size_t last_ = 0;  ///< index of the velocity that was free last time
};

}  // namespace microswarm::navigation
