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
#include "microswarm/navigation/radar/foresight.hpp"
#include "microswarm/navigation/radar/safety_filter_params.hpp"

namespace microswarm {

/// See SafetyFilterParams. For a swarm that moves into any direction at once. Allocates nothing
/// once it has seen the obstacles.
class SafetyFilter {
 public:
  using Start = EscapeStart;

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
  /// The way last ordered, as long as it is needed.
  struct Committed {
    EscapeWay way;
    double time = 0;  ///< [s]
  };
  /// What may be commanded instead, by how far it is from what is wanted.
  struct Choice {
    double turn = 0;  ///< [rad]
    Command command;
    std::optional<std::size_t> sector;  ///< of the circle; none for a hold
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
  Foresight seen_;
  EscapeFan escapes_;  ///< hold first
  EscapeFan turns_;    ///< every other of their directions

  std::optional<Committed> committed_;
  std::optional<double> course_;  ///< the heading last driven [rad]
  double waited_ = 0;             ///< told to hold, since what was wanted was last safe [s]
  std::vector<Choice> choices_;
  std::vector<EscapeSearch::Bundle> bundles_;  ///< as many as are ever taken by turns
};

}  // namespace microswarm
