// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/experiment/monitors/contact_monitor.hpp"
#include "microswarm/experiment/monitors/goal_monitor.hpp"
#include "microswarm/experiment/monitors/hold_monitor.hpp"
#include "microswarm/experiment/run/operation.hpp"
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
  const Pose2& pose() const { return present_.pose; }

 private:
  /// Current state of the swarm: the ground truth if the plant provides it, else the last
  /// observation.
  struct Present {
    double t = 0;
    Pose2 pose;
    double radius = 0;
    double speed = 0;
    double goal_distance = infinity;
  };

  bool advance(const Stop& stop);
  Command decide(const Observation& seen, const Stop& stop);
  void take_time();
  void end();
  void take_robots(const Observation& seen);
  Present present(const Observation& seen);
  std::optional<Status> follow(const GroundTruth& ground_truth);
  void fill(const Observation& seen);
  std::optional<Status> arrive();
  Status stopped() const { return at_goal_ ? Status::solved : Status::stopped; }
  bool is_autonomous() const { return mode_ == OperatingMode::autonomous; }
  void note_unseen(const Observation& seen);
  void note(EventKind kind);

  const Scenario& scenario_;
  Plant& plant_;
  Navigator* navigator_;
  const Navigator* shown_ = nullptr;  ///< whose diagnostics the tick carries
  Operation* operation_;
  OperatingMode mode_ = OperatingMode::autonomous;  ///< of the tick
  navigation::ObstacleMemory obstacles_;
  GoalMonitor goal_;
  HoldMonitor hold_;
  std::optional<ContactMonitor> contacts_;
  Present present_;
  bool was_seen_ = false;  ///< whether the swarm was seen at least once
  int unseen_ = 0;         ///< number of robots not detected
  double done_ = 0;        ///< number of ticks that count for the time limit
  bool at_goal_ = false;   ///< whether the swarm is held at the goal
  double held_ = 0;        ///< number of ticks since then
  bool touched_ = false;
  bool prepared_ = false;         ///< navigator_->prepare() was called
  std::optional<Status> ending_;  ///< set if the next tick is the last one

  Tick tick_;
  std::optional<Snapshot> world_;
  std::vector<Vec2> robots_;
  std::vector<std::string> coming_changes_;
  std::vector<std::string> changes_;
  std::vector<RunEvent> events_;
  std::vector<PoseStamped> trajectory_;
  std::string fault_;
};

}  // namespace microswarm::experiment
