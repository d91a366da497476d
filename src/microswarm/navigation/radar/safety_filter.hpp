// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/navigation/prediction/convex_outline.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/radar/safety_filter_params.hpp"

namespace microswarm {

/// See SafetyFilterParams. For a swarm that moves into any direction at once. Allocates nothing
/// once it has seen the obstacles.
class SafetyFilter {
 public:
  /// A swarm as it will be when a command takes effect.
  struct Start {
    Vec2 place;         ///< [µm]
    double radius = 0;  ///< [µm]
    double time = 0;    ///< [s]
  };

  /// `speed` is that of a way out [µm/s].
  SafetyFilter(const SafetyFilterParams& params, double speed);

  /// Takes a frame: every one, before filter() is asked about it.
  void update(const Observation& observation);
  /// Nothing when there is a way out after `wanted`, should it last for the commitment, or `tick`
  /// [s] where that is longer. Else, of the commands that leave several, the one that turns least
  /// from what is wanted and from the course that is driven: so it keeps to the side that it has
  /// begun to pass on. Where none does, how the way begins that is free for longest; of those
  /// that are for the whole horizon, the one that keeps most distance. Then also turns are tried,
  /// and a way once begun is kept to unless another is clearly better.
  std::optional<Command> filter(const Command& wanted, const Start& start, const Snapshot& world,
                                double tick);

 private:
  /// Two velocities, the second from `until` on [s].
  struct Way {
    Vec2 first;
    double until = 0;
    Vec2 second;
    Vec2 at(double t) const;
  };
  struct Outcome {
    double until_contact = 0;    ///< [s]
    double least = 0, last = 0;  ///< gap on the way and at its end, as far as more is better [µm]
    double worth() const { return least + last; }
    bool is_better_than(const Outcome& other, double tolerance) const;
  };
  /// The way last ordered, as long as it is needed.
  struct Committed {
    Way way;
    double time = 0;  ///< [s]
  };
  /// What may be commanded instead, by how far it is from what is wanted.
  struct Choice {
    double turn = 0;  ///< [rad]
    Command command;
    friend bool operator<(const Choice& a, const Choice& b) {
      return a.turn != b.turn ? a.turn < b.turn : a.command.heading < b.command.heading;
    }
  };
  /// A body that may be met.
  struct Threat {
    ConvexOutline outline;  ///< at the start
    Vec2 velocity;
    double widening = 0;  ///< of its outline [µm/s]
    double speed = 0;     ///< of its outline, at most [µm/s]
  };

  void look_at_bodies(const Start& start, const Snapshot& world);
  double gap(Vec2 p, double t, double limit, double error_rate) const;
  template <class Visit>
  bool follow(const Way& way, Visit&& visit) const;
  bool is_free(const Map& map, const Way& way) const;
  /// Incomplete once it is known to be free for less than `min_time` [s].
  Outcome outcome(const Map& map, const Way& way, double min_time) const;
  std::optional<Command> checked(const Command& wanted, const Map& map, double lasting);
  bool has_escapes(const Map& map, Vec2 begin, double lasting, int count);
  std::optional<Command> nearest_safe(const Map& map, const Command& wanted, double lasting);
  Command best_manoeuvre(const Map& map);

  SafetyFilterParams params_;
  double speed_;
  int samples_;  ///< of a way
  ObstacleTracker tracker_;
  std::vector<Vec2> velocities_;  ///< hold first
  std::size_t last_ = 0;          ///< which of them was a way out last time

  std::optional<Committed> committed_;
  std::optional<double> course_;  ///< the heading last driven [rad]
  double waited_ = 0;             ///< told to hold, since what was wanted was last safe [s]
  std::vector<Choice> choices_;
  Start start_;
  double wall_keep_ = 0;
  double gap_now_ = 0;  ///< at the start, at most the margin [µm]
  ConvexOutliner outliner_;
  std::vector<Threat> threats_;
  std::size_t bodies_ = 0;  ///< how many of threats_
  std::vector<Body> nonconvex_bodies_;
  /// Bodies that the swarm is within the hull of: as they stand when the command takes effect,
  /// since their parts move apart from one another.
  BodySet nonconvex_;
  double closing_ = 0;  ///< how fast those near the swarm come nearer [µm/s]
};

}  // namespace microswarm
