// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/radar/escape_fan.hpp"
#include "microswarm/navigation/radar/reachable_obstacles.hpp"

namespace microswarm::navigation {

/// Outcome of a trajectory.
struct EscapeOutcome {
  double until_contact = 0;    ///< [s]
  double least = 0, last = 0;  ///< minimum and final gap, each at most the counted one [µm]
  /// Score among trajectories that are free equally long [µm].
  double score() const { return least + last; }
};

/// Finds the trajectory that is free of contact for longest; among equally long ones, the one with
/// the largest gaps. A trajectory is followed only while it may still become the best.
class EscapeSearch {
 public:
  /// Evaluation of the first part of a trajectory.
  struct Trace {
    EscapeOutcome outcome{};
    bool touched = false;  ///< whether it touched a body
    bool blocked = false;  ///< whether a wall ended it
    bool is_hopeless = false;
    std::size_t times = 0;  ///< number of times evaluated
  };

  /// The trajectories of a fan after screening.
  struct Bundle {
    EscapeFan::Trajectories trajectories{};
    Trace prefix{};                          ///< the common first part
    std::vector<std::uint8_t> candidates{};  ///< for each velocity, whether it may become the best
  };

  EscapeSearch(ReachableObstacles& seen, const SafetyFilterTuning& tuning)
      : seen_(seen), tuning_(tuning) {}

  /// First part of all trajectories that turn from `first` at `until`.
  Trace begin(Vec2 first, double until);
  /// Takes the trajectory if it is clearly better than the best so far; `prefix` is its first part.
  void consider(const TwoLegTrajectory& trajectory, Trace prefix);
  void consider(const TwoLegTrajectory& trajectory) {
    consider(trajectory, begin(trajectory.first, trajectory.until));
  }
  /// Makes the best trajectory so far harder to replace, by a time [s] and a gap [µm].
  void prefer(double time, double gap);
  /// Screens the trajectories that turn from `first` at `until` to a velocity of the fan.
  void turns(Vec2 first, double until, EscapeFan& fan, Bundle& out);
  /// Screens the trajectories that hold after `until`.
  void runs(double until, EscapeFan& fan, Bundle& out);
  /// Takes the trajectory of a velocity if it passed the screening and is clearly better.
  void consider(const Bundle& bundle, const EscapeFan& fan, std::size_t velocity);
  const TwoLegTrajectory& best() const { return best_; }

 private:
  void screen(EscapeFan& fan, Bundle& out) const;
  RequiredGap least() const;
  Trace empty_trace() const {
    return {.outcome = {.until_contact = 0, .least = tuning_.counted_gap, .last = 0}};
  }
  void follow(Trace& trace, const TwoLegTrajectory& trajectory, std::span<const SampleTime> times,
              double max_last_gap) const;
  bool is_hopeless(const Trace& trace, double max_last_gap) const;
  /// Whether no trajectory can be free for longer than the best.
  bool only_gaps_count() const { return outcome_.until_contact >= seen_.end(); }
  bool is_contact(double gap, double t) const {
    return gap < tuning_.contact_gap + tuning_.contact_gap_rate * t;
  }
  /// Score that an equally long-lived trajectory must exceed [µm].
  double score_to_beat() const { return outcome_.score() + tuning_.gap_tolerance; }

  ReachableObstacles& seen_;
  const SafetyFilterTuning& tuning_;
  TwoLegTrajectory best_;
  EscapeOutcome outcome_{-1, -infinity, 0};
};

}  // namespace microswarm::navigation
