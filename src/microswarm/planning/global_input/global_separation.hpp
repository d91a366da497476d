// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm::planning {

/// Minimum distance between robots under one input, enforced along their whole moves: magnets that
/// come too close attract each other (future work of [global]).
class GlobalSeparation {
 public:
  /// `least` [µm]; 0: no minimum, everything holds.
  GlobalSeparation(const RobotStepper& stepper, ContactRule rule, double least)
      : stepper_(stepper), rule_(rule), min_distance_(static_cast<float>(least)) {}

  bool is_on() const { return min_distance_ > 0; }
  /// Whether no pair is closer.
  bool holds(std::span<const PointF> robots) const;
  /// Whether no pair comes closer anywhere on the move from `from`, where none is, to `to`.
  /// Conservative: never true if a pair does, but false also for a few moves that bring a pair
  /// within 1/64 of the move of the minimum distance.
  bool holds(std::span<const PointF> from, std::span<const PointF> to, PointF move) const;

 private:
  struct Pair {
    PointF a;
    PointF b;
  };
  Pair at(const Pair& from, const Pair& to, PointF move, float share) const;
  bool holds(const Pair& from, const Pair& to, PointF move) const;
  bool holds_between(const Pair& from, const Pair& to, PointF move, float low, const Pair& at_low,
                     float high, const Pair& at_high, int halvings) const;

  const RobotStepper& stepper_;
  ContactRule rule_;
  float min_distance_;
};

}  // namespace microswarm::planning
