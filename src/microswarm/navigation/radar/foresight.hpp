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

namespace microswarm {

/// A swarm as it will be when a command takes effect.
struct EscapeStart {
  Vec2 place;         ///< [µm]
  double radius = 0;  ///< [µm]
  double time = 0;    ///< [s]
};

/// Two velocities, the second from `until` on [s].
struct EscapeWay {
  Vec2 first;
  double until = 0;
  Vec2 second;
  /// Displacement after `t` seconds [µm].
  Vec2 at(double t) const { return std::min(t, until) * first + std::max(0.0, t - until) * second; }
};

/// What of the walls and the moving bodies a swarm may meet on its ways from one place, as far as
/// is foreseen. At each time, only bodies are looked at that it can come near to by then; the gaps
/// are those to all bodies, to the bit. Allocates nothing once it has seen the obstacles.
class Foresight {
 public:
  /// A time of a way [s] and the bodies that matter then.
  struct Instant {
    double t = 0;
    double required = 0;  ///< gap that a free way has then [µm]
    std::uint32_t first = 0, last = 0;
  };
  /// The times at which a way that turns at `until` is looked at; of the first `shared`, where it
  /// is depends only on its first velocity.
  struct Schedule {
    double until = 0;
    std::vector<Instant> instants;
    std::size_t shared = 0;
    std::span<const Instant> begun() const { return std::span(instants).first(shared); }
    std::span<const Instant> rest() const { return std::span(instants).subspan(shared); }
    /// The last of begun(), or 0 [s].
    double before() const { return shared > 0 ? instants[shared - 1].t : 0; }
  };
  /// Whether the motion of the bodies is taken for as uncertain as `gap_rate` says.
  enum class Error : std::uint8_t { none, bounded };
  /// A body at an instant.
  struct Near {
    Vec2 centre;
    std::array<double, 2> touch{};  ///< distance of contact, by Error [µm]
    const ConvexOutline* outline = nullptr;
  };

  /// `speed` is that of a way out [µm/s].
  Foresight(const SafetyFilterParams& params, double speed);

  /// Bodies farther from the swarm than this do not matter [µm].
  double range() const;
  /// No velocity of the ways asked about exceeds `top_speed` [µm/s]. The tracker has taken the
  /// frame of `world`.
  void look(const EscapeStart& start, const Snapshot& world, const ObstacleTracker& tracker,
            double top_speed);
  /// Whether nothing that moves can be met.
  bool empty() const { return bodies_ == 0 && nonconvex_.empty(); }
  const EscapeStart& start() const { return start_; }
  /// The end of all ways [s].
  double end() const { return samples_ * params_.step; }
  /// Reference valid until the next look().
  const Schedule& schedule(double until);
  std::span<const Near> near(const Instant& i) const {
    return {near_.data() + i.first, near_.data() + i.last};
  }
  /// Whether near() is all that moves and can be met.
  bool all_convex() const { return nonconvex_.empty(); }

  /// Gap [µm] of the swarm at `p` to what moves, at most `limit`, which is at most max_limit().
  double gap(Vec2 p, const Instant& at, double limit, Error error) const;
  double max_limit() const;
  /// Whether the gap at `p` is what a free way has.
  bool is_clear(Vec2 p, const Instant& at) const;
  /// Whether a swarm can get from `a`, where it was before, to `b`, where it is at time `t`,
  /// without coming too near to walls.
  bool is_free_of_walls(Vec2 a, Vec2 b, double t) const {
    return t <= walls_from_ || a == b || world_->map().is_free(Segment{a, b}, wall_keep_);
  }
  /// Whether a swarm surely keeps away from walls on a straight way. Where neither this nor
  /// meets_walls() holds, rounding decides: is_free_of_walls() tells, from instant to instant.
  bool passes_walls(const Segment& way) const;
  /// Whether it surely comes too near to walls on this way and all that are parallel to it, at most
  /// `slack` [µm] aside.
  bool meets_walls(const Segment& way, double slack = 0) const;
  /// Until then no wall is in reach [s].
  double walls_from() const { return walls_from_; }

 private:
  /// A body that may be met.
  struct Threat {
    ConvexOutline outline;  ///< at the start
    Vec2 velocity;
    double widening = 0;  ///< of its outline [µm/s]
    double speed = 0;     ///< of its outline, at most [µm/s]
  };

  void find_threats(const ObstacleTracker& tracker);
  void look_at_walls(double top_speed);
  Instant foresee(double t);
  double grown_for(double t) const;

  SafetyFilterParams params_;
  double speed_;
  int samples_;  ///< of a way
  ConvexOutliner outliner_;

  EscapeStart start_;
  const Snapshot* world_ = nullptr;
  double seen_ = 0;  ///< the frame's time [s]
  double top_speed_ = 0;
  double gap_now_ = 0;  ///< at the start, at most the margin [µm]
  double wall_keep_ = 0;
  double walls_from_ = 0;
  std::vector<Threat> threats_;
  std::size_t bodies_ = 0;  ///< how many of threats_
  std::vector<Near> near_;  ///< of all instants
  std::vector<Instant> samples_seen_;
  std::deque<Schedule> schedules_;
  std::size_t scheduled_ = 0;  ///< how many of schedules_
  std::vector<Body> nonconvex_bodies_;
  /// Bodies that the swarm is within the hull of: as they stand when the command takes effect,
  /// since their parts move apart from one another.
  BodySet nonconvex_;
  double closing_ = 0;  ///< how fast those near the swarm come nearer [µm/s]
};

}  // namespace microswarm
