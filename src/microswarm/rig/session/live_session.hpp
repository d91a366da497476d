// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/experiment/session/session.hpp"
#include "microswarm/rig/commissioning/commissioning.hpp"
#include "microswarm/rig/runtime/coil_notes.hpp"
#include "microswarm/rig/runtime/coil_temperatures.hpp"
#include "microswarm/rig/runtime/command_log.hpp"
#include "microswarm/rig/runtime/devices.hpp"
#include "microswarm/rig/runtime/disk_space.hpp"
#include "microswarm/rig/runtime/live_rig.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"
#include "microswarm/vision/camera/video_recorder.hpp"

namespace microswarm::rig {

/// Options for opening a rig in real time.
struct LiveOptions {
  bool dry = false;   ///< no current is sent to the coils
  bool idle = false;  ///< in a dry run, a simulated swarm does not move
  std::filesystem::path
      folder{};  ///< folder of commands.csv; empty: the coil outputs are not logged
  std::filesystem::path video{};  ///< file for the camera's video; empty for none
  bool without_limits = false;  ///< allows a coil system without limits of current and temperature
  bool uncommissioned = false;  ///< allows a rig that was not measured, to measure it
  bool coils_cold = false;      ///< assumes the coils at ambient temperature
  std::string note{};           ///< operator's note, kept in the record
  std::optional<double> seconds{};      ///< after which the run is stopped, for the space it needs
  std::size_t max_logged = 10'000'000;  ///< values kept of the currents, and of the sightings
  /// Space that is free for a folder [B]; another one for tests.
  std::function<std::optional<double>(const std::filesystem::path&)> free_space = rig::free_space;
  std::function<void()> driven{};  ///< called in the coils' thread after each output
};

/// Live numbers of a run on a rig.
struct LiveStatus {
  double t = 0;  ///< on the record's clock [s]
  NavigatorState state = NavigatorState::hold;
  bool holding = false;      ///< whether the swarm is held at the goal
  double goal_distance = 0;  ///< [µm], infinite before the first detection
  double command_speed = 0;  ///< [µm/s]
  double radius = 0;         ///< of the swarm [µm]
  double gap = infinity;     ///< from its edge to walls and obstacles [µm]; infinite for robots
  std::optional<NotFound> not_found{};  ///< why the swarm is not detected; empty if it is
  int robots = 0;                       ///< individually tracked robots
  int unseen = 0;                       ///< robots not detected
  CoilLoad coils{};
  double frame_age = 0;      ///< of the newest picture [s]
  double tick_p95 = 0;       ///< 95th percentile of the ticks' durations [s]
  int missed_deadlines = 0;  ///< ticks that ended too late
};

/// A session on a rig in real time, with its devices: a step takes the time of a tick. The
/// destructor sets the coils to zero.
class LiveSession {
 public:
  /// Checks and opens the rig's devices. Throws HardwareError if a device fails, InputError if rig
  /// and scenario do not fit, if the coils cannot hold the field, if a limit is missing, or if
  /// the folder's disk has clearly too little space.
  LiveSession(RigExperiment on, const LiveOptions& options);
  ~LiveSession() = default;
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  experiment::Session& session() { return session_; }
  const experiment::Session& session() const { return session_; }
  /// Warnings about the rig, found when it was opened, one line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Sets the coils to zero permanently; callable from any thread. A stop of the kind `none` is no
  /// fault: the thread that steps the session must end it too. Returns the report of the first
  /// stop.
  actuation::StopReport stop(const std::string& why, FaultKind kind = FaultKind::person);
  /// Sets the frequency of the field [Hz] and records the change; to be called in the thread that
  /// steps.
  void set_field_frequency(double frequency);
  /// State of the rig's commissioning record when the session was opened.
  const CommissioningState& commissioning() const { return commissioning_; }
  /// Sets the coils to zero after the last tick, finishes the log and adds currents and detections
  /// to the record, up to `max_logged` values of each. Returns the reason of a failure, or an empty
  /// string.
  std::string close();
  /// Why the run ended with a fault, or why zero is not sure; empty otherwise. Sets the coils to
  /// zero after the last tick.
  std::string fault();
  /// Kind of that fault.
  FaultKind fault_kind();
  /// After close(): the recorded video, if requested.
  std::optional<vision::RecordedVideo> video() const;
  /// Notes that came up since the last call, each once: little space on the disk, more values
  /// than the record keeps, broken probes and hot coils, changes of the pictures. To be called in
  /// the thread that steps.
  std::vector<std::string> take_notes();
  /// Numbers of the newest tick; to be called in the thread that steps.
  LiveStatus status() const;
  const Rig& rig() const { return on_.rig; }
  /// The rig in real time: its newest picture and its times.
  const LiveRig& live() const { return *plant_; }

 private:
  void warn_of_slow_ticks();
  void require_map();
  void open_coils(const LiveOptions& options);
  void require(const std::vector<RigCheck>& checks);
  void keep(const Detections& seen, double t);
  void keep_picture_state(double t);
  void keep(const CoilMoment& moment);
  std::string look_at_disk();

  LiveOptions options_;
  double map_limit_;  ///< [px], before checks are disabled
  RigExperiment on_;
  CommissioningState commissioning_;
  Devices devices_;
  experiment::RigLog kept_;  ///< currents are written by the coils' thread, the rest by the run's
  CommandLog log_;
  std::unique_ptr<vision::VideoRecorder> video_;
  std::vector<std::string> warnings_;
  std::atomic<bool> currents_full_ = false;
  CoilNotes coil_notes_;
  bool told_currents_ = false, told_sightings_ = false, told_space_ = false;
  double disk_due_ = 0;   ///< time of the next look at the disk [s]
  double state_due_ = 0;  ///< time of the next state of the pictures that is kept [s]
  std::optional<CoilTemperatures> temperatures_;
  std::shared_ptr<LiveRig> plant_;
  experiment::Session session_;
};

}  // namespace microswarm::rig
