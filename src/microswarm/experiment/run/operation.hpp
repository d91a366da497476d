// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "microswarm/navigation/manual/manual_navigator.hpp"

namespace microswarm::experiment {

/// Source of a tick's command: the experiment's navigator, manual steering, or a hold.
enum class OperatingMode { autonomous, manual, paused };

/// Manual operation of a running experiment. Every function may be called from any thread and takes
/// effect at the next tick. The record holds each tick's mode in its state, and a replay repeats
/// it.
class Operation {
 public:
  /// `max_speed` [µm/s] of the swarm.
  explicit Operation(double max_speed) : by_hand_(max_speed) {}

  /// Holds the swarm until it is resumed. The scenario's time limit is suspended meanwhile; faults
  /// still end the run.
  void pause(bool paused = true) {
    by_hand_.release();
    paused_ = paused;
  }
  /// Selects whether steer() commands the swarm instead of the navigator; then no goal is reached.
  void manual(bool manual = true) {
    by_hand_.release();
    manual_ = manual;
  }
  /// Commands the swarm for half a second (ManualNavigator) if it is steered manually and not
  /// paused.
  void steer(const Command& command) {
    if (mode() == OperatingMode::manual) by_hand_.steer(command);
  }
  /// Ends the run like a stop: `solved` at the goal, else `stopped`.
  void end() { ended_ = true; }

  /// Largest speed that steer() commands [µm/s].
  double max_speed() const { return by_hand_.max_speed(); }
  bool is_paused() const { return paused_; }
  bool is_manual() const { return manual_; }
  bool is_ended() const { return ended_; }
  OperatingMode mode() const {
    if (paused_) return OperatingMode::paused;
    return manual_ ? OperatingMode::manual : OperatingMode::autonomous;
  }
  navigation::ManualNavigator& by_hand() { return by_hand_; }

 private:
  navigation::ManualNavigator by_hand_;
  std::atomic<bool> paused_ = false;
  std::atomic<bool> manual_ = false;
  std::atomic<bool> ended_ = false;
};

}  // namespace microswarm::experiment
