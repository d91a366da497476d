// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "microswarm/navigation/manual/manual_navigator.hpp"

namespace microswarm {

/// Who decides in a tick: the experiment's navigator, a person, or nobody: the swarm holds.
enum class OperatingMode { autonomous, manual, paused };

/// How a person operates a running experiment. Every function may be called from any thread and
/// counts from the next tick on. The record shows each tick's mode by its state, and a replay
/// repeats it.
class Operation {
 public:
  /// `max_speed` [µm/s] of the swarm.
  explicit Operation(double max_speed) : by_hand_(max_speed) {}

  /// Holds the swarm until it is resumed. The time limit of the scenario does not run meanwhile;
  /// faults end the run as ever.
  void pause(bool paused = true) {
    by_hand_.release();
    paused_ = paused;
  }
  /// Whether steer() commands the swarm, in place of the navigator. Its goal is then not reached.
  void manual(bool manual = true) {
    by_hand_.release();
    manual_ = manual;
  }
  /// Commands the swarm for half a second (ManualNavigator), if it is steered by hand and not
  /// paused; else nothing.
  void steer(const Command& command) {
    if (mode() == OperatingMode::manual) by_hand_.steer(command);
  }
  /// Ends the run in order, as a stop: `solved` at the goal, else `stopped`.
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
  ManualNavigator& by_hand() { return by_hand_; }

 private:
  ManualNavigator by_hand_;
  std::atomic<bool> paused_ = false;
  std::atomic<bool> manual_ = false;
  std::atomic<bool> ended_ = false;
};

}  // namespace microswarm
