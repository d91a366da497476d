// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/radar/escape_fan.hpp"
#include "microswarm/navigation/radar/escape_search.hpp"
#include "microswarm/navigation/radar/reachable_obstacles.hpp"
#include "microswarm/navigation/radar/safety_filter_params.hpp"

namespace microswarm::navigation {

/// Safety filter of a command, see SafetyFilterParams. For holonomic swarms. Does not allocate once
/// it has seen the obstacles.
class SafetyFilter {
 public:
  using Start = EscapeStart;

  /// `speed`: speed of an escape [µm/s].
  SafetyFilter(const SafetyFilterParams& params, double speed);

  /// Processes a frame; to be called for each one, before filter().
  void update(const Observation& observation);
  /// Command in place of `wanted`, which is assumed to last for the commitment, or for `tick` [s]
  /// if that is longer:
  /// 1. nothing if an escape remains after `wanted`;
  /// 2. else, of the commands that leave several escapes, the one with the smallest sum of turns
  ///    from `wanted` and from the current course, so that a side once chosen is kept;
  /// 3. else the start of the trajectory that is free for longest or, among those free for the
  /// whole
  ///    horizon, keeps the largest gaps. These include turns; the trajectory of the last call is
  ///    kept unless another one is clearly better.
  std::optional<Command> filter(const Command& wanted, const Start& start, const Snapshot& world,
                                double tick);

 private:
  /// Trajectory commanded last, as long as it is needed.
  struct Committed {
    TwoLegTrajectory trajectory;
    double time = 0;  ///< [s]
  };
  /// An alternative command, ordered by its turn from the wanted command and the course.
  struct Choice {
    double turn = 0;  ///< [rad]
    Command command;
    std::optional<std::size_t> sector;  ///< sector of the circle; none for a hold
    friend bool operator<(const Choice& a, const Choice& b) {
      return a.turn != b.turn ? a.turn < b.turn : a.command.heading < b.command.heading;
    }
  };

  std::optional<Command> checked(const Command& wanted, double lasting);
  std::optional<Command> nearest_safe(const Command& wanted, double lasting);
  void list_choices(const Command& wanted);
  Command best_manoeuvre();

  SafetyFilterParams params_;
  double speed_;
  ObstacleTracker tracker_;
  ReachableObstacles seen_;
  EscapeFan escapes_;  ///< the hold is first
  EscapeFan turns_;    ///< every other of these directions

  std::optional<Committed> committed_;
  std::optional<double> course_;  ///< last heading driven [rad]
  double waited_ = 0;             ///< time of commanded holds since `wanted` was last safe [s]
  std::vector<Choice> choices_;
  std::vector<EscapeSearch::Bundle> bundles_;  ///< as many as are evaluated in turn at most
};

}  // namespace microswarm::navigation
