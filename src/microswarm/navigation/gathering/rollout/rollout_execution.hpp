// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "microswarm/navigation/gathering/rollout/rollout_simulator.hpp"

namespace microswarm::navigation {

/// A rollout plan that is being executed: its moves, the number of executed ones, and the expected
/// positions of the robots.
class RolloutExecution {
 public:
  RolloutExecution() : expected_(Robots{}) {}

  /// Starts a plan for these robots.
  void start(const Robots& robots, RolloutPlan&& plan);
  /// Executes the next move [µm]: moves the expected robots by the rule "stop".
  Vec2 advance(const CommonInput& input);
  /// Replaces the steps after `partial.from` if that makes the plan shorter; returns whether it
  /// does. `partial` must have kept its checkpoints and begin after the executed moves.
  bool shorten(PartialPlan&& partial);

  /// Number of robots that it was started for.
  std::size_t robot_count() const { return expected_.size(); }
  /// Sum of the distances [µm] of the robots from their expected positions.
  double deviation(const Robots& robots) const;

  /// All moves, executed or not.
  std::span<const Vec2> moves() const { return plan_.moves; }
  /// Robots before every 16th move.
  std::span<const MergedRobots> checkpoints() const { return plan_.checkpoints; }
  /// Number of all moves.
  std::size_t steps() const { return plan_.moves.size(); }
  /// Number of executed moves.
  std::size_t done() const { return done_; }
  /// Number of moves left.
  std::size_t left() const { return steps() - done_; }

 private:
  RolloutPlan plan_;
  std::size_t done_ = 0;
  MergedRobots expected_;
};

}  // namespace microswarm::navigation
