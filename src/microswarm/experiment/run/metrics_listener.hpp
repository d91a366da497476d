// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/experiment/run/run_listener.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::experiment {

/// Accumulates a run's metrics, up to the arrival if the swarm is held at the goal, and the
/// navigator's times. If the plant provides no ground truth,
/// clearances are computed from observations.
class MetricsListener : public RunListener {
 public:
  /// `result` receives the result so far; its status is `running` until the last tick. It must
  /// outlive the listener.
  MetricsListener(const Scenario& scenario, RunResult& result);
  void on_tick(const Tick& tick) override;

 private:
  void move_to(const Pose2& pose);
  void note_distance(const Tick& tick);
  void note_contacts(const Tick& tick);
  void hold(const Tick& tick);
  void note_step(const Tick& tick);
  void note_clearances(const Tick& tick);
  void note_end(const Tick& tick);
  void summarise(const Frame& newest);

  double tick_;  ///< [s]
  std::optional<Pose2> at_;
  double cost_sum_ = 0;
  double gap_sum_ = 0;  ///< [µm]
  int detected_ticks_ = 0;
  bool is_held_ = false;  ///< at the goal
  RunResult& result_;
};

}  // namespace microswarm::experiment
