// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/run/metrics_listener.hpp"

namespace microswarm::experiment {

/// Keeps a run and its metrics in memory. Robot positions are kept at 64 to 128 equally spaced
/// frames and at the end.
class Recorder : public RunListener {
 public:
  /// `rig` is the name of the rig, if the run is on one.
  explicit Recorder(Scene scene, std::uint32_t trial = 0, std::string rig = {});
  ~Recorder() override = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void on_tick(const Tick& tick) override;
  /// Notes that the navigator is not the scenario's.
  void note_external_navigator() { record_.navigator = "external"; }

  /// For what a rig logs beside the run.
  RigLog& rig_log() { return record_.rig_log; }
  /// The record so far; complete after the last tick.
  const Record& record() const { return record_; }
  Record take() { return std::move(record_); }

 private:
  void keep_robots(const Tick& tick);

  Record record_;
  MetricsListener metrics_;       ///< into the record's result
  std::size_t robot_period_ = 1;  // frames
  std::size_t robot_frames_ = 0;
};

}  // namespace microswarm::experiment
