// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/radar/escape_fan.hpp"
#include "microswarm/navigation/radar/foresight.hpp"

namespace microswarm {

/// What comes of a way.
struct EscapeOutcome {
  double until_contact = 0;    ///< [s]
  double least = 0, last = 0;  ///< gap on the way and at its end, as far as more is better [µm]
  double worth() const { return least + last; }
};

/// Finds the way that is free of contact for longest; of those that are alike in that, the one
/// that keeps most distance. A way is followed no farther than it may still be the best.
class EscapeSearch {
 public:
  /// How a way began.
  struct Trace {
    EscapeOutcome outcome;
    bool touched = false;  ///< a body
    bool blocked = false;  ///< by a wall, and ended
    bool is_hopeless = false;
    std::size_t instants = 0;  ///< how many are behind
  };

  /// The ways of a fan, and what is known of them before one is followed.
  struct Bundle {
    EscapeFan::Ways ways;
    Trace begun;                     ///< as all do
    std::vector<std::uint8_t> left;  ///< whether it may become the best, by velocity
  };

  EscapeSearch(Foresight& seen, const SafetyFilterTuning& tuning) : seen_(seen), tuning_(tuning) {}

  /// The beginning that all ways share which turn from `first` at `until`.
  Trace begin(Vec2 first, double until);
  /// Takes the way if it is clearly better than the best so far; `begun` is how it begins.
  void consider(const EscapeWay& way, Trace begun);
  void consider(const EscapeWay& way) { consider(way, begin(way.first, way.until)); }
  /// Makes the best way so far harder to replace, by a time [s] and a gap [µm].
  void prefer(double time, double gap);
  /// Screens the ways that turn from `first` at `until` into another velocity of the fan.
  void turns(Vec2 first, double until, EscapeFan& fan, Bundle& out);
  /// Screens those that hold after `until`.
  void runs(double until, EscapeFan& fan, Bundle& out);
  /// Takes that velocity's way, if it is left and clearly better.
  void consider(const Bundle& bundle, const EscapeFan& fan, std::size_t velocity);
  const EscapeWay& best() const { return best_; }

 private:
  void screen(EscapeFan& fan, Bundle& out) const;
  LeastGap least() const;
  Trace nothing_behind() const {
    return {.outcome = {.until_contact = 0, .least = tuning_.counted_gap, .last = 0}};
  }
  void follow(Trace& trace, const EscapeWay& way, std::span<const Foresight::Instant> instants,
              double most_last) const;
  bool is_hopeless(const Trace& trace, double most_last) const;
  /// Whether no way can be free for longer than the best.
  bool only_gaps_count() const { return outcome_.until_contact >= seen_.end(); }
  bool is_contact(double gap, double t) const {
    return gap < tuning_.contact_gap + tuning_.contact_gap_rate * t;
  }
  /// What a way's worth must exceed that is free for as long as the best [µm].
  double bar() const { return outcome_.worth() + tuning_.gap_tolerance; }

  Foresight& seen_;
  const SafetyFilterTuning& tuning_;
  EscapeWay best_;
  EscapeOutcome outcome_{-1, -infinity, 0};
};

}  // namespace microswarm
