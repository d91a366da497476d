// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/execution/mutex.hpp"

namespace microswarm::navigation {

/// Executes commands that a person gives, for example by keys. Each lasts for a limited time, in
/// which the next one must come; then the swarm holds. It keeps the swarm's speed limit and avoids
/// nothing.
class ManualNavigator : public Navigator {
 public:
  static constexpr double default_duration = 0.5;  // [s]

  /// `max_speed` [µm/s] of the swarm; `duration` [s] of a command.
  explicit ManualNavigator(double max_speed, double duration = default_duration)
      : max_speed_(max_speed), duration_(duration) {}

  /// Sets the command, from any thread. It counts from the next step on. A command that is not
  /// finite is a hold.
  void steer(const Command& command);
  /// Drops the command, from any thread: the swarm holds.
  void release();
  Command step(const Observation& seen, const Stop& stop) override;
  double max_speed() const { return max_speed_; }  ///< [µm/s]
  NavigatorView view() const override { return view_; }

 private:
  double max_speed_;
  double duration_;
  Mutex mutex_;
  std::optional<Command> next_;     // not yet taken by a step
  std::optional<Command> command_;  // in effect
  double since_ = 0;                // when it was taken [s]
  double heading_ = 0;              // of the last command [rad]
  NavigatorView view_;
};

}  // namespace microswarm::navigation
