// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm {

/// Least distance that robots under one input keep from each other, all along their moves: magnets
/// that come too near attract each other (future work of [global]).
class GlobalSeparation {
 public:
  /// `least` [µm]; 0: none, everything holds.
  GlobalSeparation(const RobotStepper& stepper, ContactRule rule, double least)
      : stepper_(stepper), rule_(rule), least_(static_cast<float>(least)) {}

  bool is_on() const { return least_ > 0; }
  /// Is no pair nearer?
  bool holds(std::span<const PointF> robots) const;
  /// Is no pair nearer anywhere on the move that brings robots from `from`, where none is, to `to`?
  /// Never true when one is; false also for a few moves that bring a pair within a 64th of the move
  /// of the least distance.
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
  float least_;
};

}  // namespace microswarm
