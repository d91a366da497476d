// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/monitors/contact_monitor.hpp"
#include "microswarm/experiment/monitors/goal_monitor.hpp"
#include "microswarm/experiment/monitors/hold_monitor.hpp"
#include "microswarm/experiment/run/operation.hpp"
#include "microswarm/experiment/run/run_clock.hpp"
#include "microswarm/experiment/run/swarm_state.hpp"
#include "microswarm/experiment/run/tick.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/navigation/prediction/obstacle_memory.hpp"

namespace microswarm::experiment {

/// Runs an experiment tick by tick: observe, decide, apply. Contacts and arrival are detected in
/// continuous time. For individually tracked robots the goal is tested once per tick, and walls are
/// not contacts. After the arrival it continues for the scenario's `hold_at_goal`: the navigator
/// keeps the swarm at the goal, and returns it if it drifts away.
///
///     Episode episode(scenario, plant, navigator);
///     while (const Tick* tick = episode.step()) listener.on_tick(*tick);
class Episode {
 public:
  /// All arguments must outlive the episode. `operation`: manual operation, if any.
  Episode(const Scenario& scenario, Plant& plant, Navigator& navigator,
          Operation* operation = nullptr);

  /// The next tick; null after the last one. `end` of the last tick is `solved`, `collided`, `held`
  /// (held for the scenario's hold limit, or until its time limit), `time_limit`, `stopped`, or
  /// `fault`.
  const Tick* step(const Stop& stop = {});
  /// Whether the last tick was taken.
  bool over() const { return tick_.end.has_value(); }

  /// Continues with the current state of the scenario and of the plant's obstacles, and with
  /// `navigator`, which may be the current one. `setting` is reported with the next tick.
  void change(const std::string& setting, Navigator& navigator);

  /// Pose of the swarm, or the last observed one.
  const Pose2& pose() const { return state_.now().pose; }

 private:
  /// Values that the tick refers to.
  struct TickData {
    std::optional<Snapshot> world;
    std::vector<Vec2> robots;
    std::vector<std::string> changes;
    std::vector<RunEvent> events;
    std::vector<PoseStamped> trajectory;
  };

  bool advance(const Stop& stop);
  Command decide(const Observation& seen, const Stop& stop);
  void take_time();
  void end();
  std::optional<Status> follow(const GroundTruth& ground_truth);
  void fill(const Observation& seen);
  std::optional<Status> arrive();
  Status stopped() const { return clock_.at_goal() ? Status::solved : Status::stopped; }
  bool is_autonomous() const { return mode_ == OperatingMode::autonomous; }
  void note(EventKind kind);

  const Scenario& scenario_;
  Plant& plant_;
  Navigator* navigator_;
  const Navigator* shown_ = nullptr;  ///< whose diagnostics the tick carries
  Operation* operation_;
  OperatingMode mode_ = OperatingMode::autonomous;  ///< of the tick
  navigation::ObstacleMemory obstacles_;
  SwarmState state_;
  RunClock clock_;
  GoalMonitor goal_;
  HoldMonitor hold_;
  std::optional<ContactMonitor> contacts_;
  bool touched_ = false;
  bool prepared_ = false;         ///< navigator_->prepare() was called
  std::optional<Status> ending_;  ///< set if the next tick is the last one
  std::string fault_;
  std::vector<std::string> coming_changes_;
  Tick tick_;
  TickData data_;
};

}  // namespace microswarm::experiment
