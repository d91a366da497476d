// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/prediction/convex_outline.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/radar/safety_filter_params.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::navigation {

/// Predicted state of the swarm when a command takes effect.
struct EscapeStart {
  Vec2 position{};    ///< [µm]
  double radius = 0;  ///< [µm]
  double time = 0;    ///< [s]
};

/// Two-leg trajectory: a first velocity, and a second one from `until` on [s]. Velocities [µm/s].
struct TwoLegTrajectory {
  Vec2 first{};
  double until = 0;
  Vec2 second{};
  /// Displacement after `t` seconds [µm].
  Vec2 at(double t) const { return std::min(t, until) * first + std::max(0.0, t - until) * second; }
};

/// A sample time [s] and the range of the bodies within reach then.
struct SampleTime {
  double t = 0;
  double required = 0;  ///< gap required of a free trajectory [µm]
  std::uint32_t first = 0, last = 0;
};
/// Sample times of a two-leg trajectory that turns at `until` [s]; the first `shared` lie on the
/// first leg.
struct SampleTimes {
  double until = 0;
  std::vector<SampleTime> times{};
  std::size_t shared = 0;
  std::span<const SampleTime> first_leg() const { return std::span(times).first(shared); }
  std::span<const SampleTime> second_leg() const { return std::span(times).subspan(shared); }
  /// Last time on the first leg, or 0 [s].
  double before() const { return shared > 0 ? times[shared - 1].t : 0; }
};

/// Walls and predicted bodies that a swarm can reach from one start within the horizon. At each
/// time only the bodies within reach by then are tested; the gaps are bit-identical to those of all
/// bodies. Does not allocate once it has seen the obstacles.
class ReachableObstacles {
 public:
  /// Assumed error of the bodies' motion: none, or one that grows by `gap_rate`.
  enum class MotionError : std::uint8_t { none, bounded };
  /// A predicted body at a sample time.
  struct NearBody {
    Vec2 centre{};
    std::array<double, 2> touch{};  ///< distance of contact for each MotionError [µm]
    const ConvexOutline* outline = nullptr;
  };

  /// `speed`: speed of an escape [µm/s].
  ReachableObstacles(const SafetyFilterParams& params, double speed);

  /// Distance from the swarm beyond which bodies are ignored [µm].
  double range() const;
  /// Predicts for a new start. `top_speed` bounds the velocities of all later queries [µm/s]. The
  /// tracker must have processed the frame of `world`.
  void predict(const EscapeStart& start, const Snapshot& world, const ObstacleTracker& tracker,
               double top_speed);
  /// Whether no moving body is within reach.
  bool empty() const { return bodies_ == 0 && nonconvex_.empty(); }
  const EscapeStart& start() const { return start_; }
  /// End time of all trajectories [s].
  double end() const { return samples_ * params_.step; }
  /// Sample times for a turn at `until` [s]; valid until the next predict().
  const SampleTimes& sample_times(double until);
  std::span<const NearBody> near(const SampleTime& i) const {
    return {near_.data() + i.first, near_.data() + i.last};
  }
  /// Whether near() holds all moving bodies within reach.
  bool all_convex() const { return nonconvex_.empty(); }

  /// Gap [µm] of the swarm at `p` to moving bodies, at most `limit`, which is at most max_limit().
  double gap(Vec2 p, const SampleTime& at, double limit, MotionError error) const;
  double max_limit() const;
  /// Whether the gap at `p` is the required one.
  bool is_clear(Vec2 p, const SampleTime& at) const;
  /// Whether a swarm that moves from `a` to `b`, which it reaches at time `t` [s], keeps away from
  /// walls.
  bool is_free_of_walls(Vec2 a, Vec2 b, double t) const {
    return t <= walls_from_ || a == b || world_->map().is_free(Segment{a, b}, wall_keep_);
  }
  /// Whether a swarm certainly keeps away from walls on a segment. If neither this nor
  /// meets_walls() holds, rounding decides, and is_free_of_walls() has to be asked at each sample
  /// time.
  bool passes_walls(const Segment& segment) const;
  /// Whether it certainly comes too near to walls on this segment and on all parallels at most
  /// `slack` [µm] aside.
  bool meets_walls(const Segment& segment, double slack = 0) const;
  /// Time until which no wall is within reach [s].
  double walls_from() const { return walls_from_; }

 private:
  /// A body that may come within reach.
  struct Threat {
    ConvexOutline outline;  ///< at the start
    Vec2 velocity;
    double widening = 0;  ///< growth of its outline [µm/s]
    double speed = 0;     ///< upper bound of its outline's speed [µm/s]
  };

  void find_threats(const ObstacleTracker& tracker);
  void look_at_walls(double top_speed);
  SampleTime predict_at(double t);
  double grown_for(double t) const;

  SafetyFilterParams params_;
  double speed_;
  int samples_;  ///< number of sample times
  ConvexOutliner outliner_;

  EscapeStart start_;
  const Snapshot* world_ = nullptr;
  double seen_ = 0;  ///< time of the frame [s]
  double top_speed_ = 0;
  double gap_now_ = 0;  ///< gap at the start, at most the margin [µm]
  double wall_keep_ = 0;
  double walls_from_ = 0;
  std::vector<Threat> threats_;
  std::size_t bodies_ = 0;      ///< number of threats_ in use
  std::vector<NearBody> near_;  ///< bodies of all sample times
  std::vector<SampleTime> sampled_;
  std::deque<SampleTimes> schedules_;
  std::size_t scheduled_ = 0;  ///< number of schedules_ in use
  std::vector<Body> nonconvex_bodies_;
  /// Bodies whose convex hull contains the swarm, at their positions when the command takes effect,
  /// since their parts move independently.
  BodySet nonconvex_;
  double closing_ = 0;  ///< approach speed of the bodies near the swarm [µm/s]
};

}  // namespace microswarm::navigation
