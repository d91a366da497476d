// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "microswarm/rig/runtime/devices.hpp"
#include "microswarm/rig/runtime/live_rig.hpp"
#include "microswarm/session/session.hpp"
#include "microswarm/vision/camera/video_recorder.hpp"

namespace microswarm {

/// Options for opening a rig in real time.
struct LiveOptions {
  bool dry = false;   ///< no current is sent to the coils
  bool idle = false;  ///< in a dry run, a simulated swarm does not move
  std::filesystem::path
      folder{};  ///< folder of commands.csv; empty: the coil outputs are not logged
  std::filesystem::path video{};  ///< file for the camera's video; empty for none
  bool without_limits = false;  ///< allows a coil system without limits of current and temperature
  bool coils_cold = false;      ///< assumes the coils at ambient temperature
  std::string note{};           ///< operator's note, kept in the record
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
  std::string_view trouble;  ///< why the swarm is not detected, see Detections; empty if it is
  int robots = 0;            ///< individually tracked robots
  int unseen = 0;            ///< robots not detected
  CoilLoad coils;
  double frame_age = 0;      ///< of the newest picture [s]
  double tick_p95 = 0;       ///< 95th percentile of the ticks' durations [s]
  int missed_deadlines = 0;  ///< ticks that ended too late
};

/// A session on a rig in real time: a step takes the time of a tick. The destructor sets the coils
/// to zero.
class LiveSession : public Session {
 public:
  /// Checks and opens the rig's devices. Throws HardwareError if a device fails, InputError if rig
  /// and scenario do not fit, if the coils cannot hold the field, or if a limit is missing.
  static std::unique_ptr<LiveSession> open(const RigExperiment& on, const LiveOptions& options);

  /// Warnings about the rig, found when it was opened, one line each.
  const std::vector<std::string>& warnings() const;
  /// Sets the coils to zero permanently; callable from any thread.
  void stop(const std::string& why);
  /// Sets the coils to zero after the last tick, finishes the log and adds currents and detections
  /// to the record, up to 10,000,000 values of each. Returns the reason of a failure, or an empty
  /// string.
  std::string close();
  /// After stop(): whether the device confirmed zero currents.
  bool zero_is_confirmed() const;
  /// After stop(): CoilDriver::stop_trouble.
  std::string stop_trouble() const;
  /// After close(): the recorded video, if requested.
  std::optional<RecordedVideo> video() const;
  RigTiming timing() const;
  /// Numbers of the newest tick; to be called in the thread that steps.
  LiveStatus status() const;
  /// The newest picture of the camera, grey, and its scale; to be called in the thread that steps.
  const Image& picture() const;
  const CameraScale& camera_scale() const;
  const Rig& rig() const;
  /// Number of times the coils had switched off by themselves.
  int resumed() const;
  /// Number of outputs that the device's own limits weakened.
  int weakened() const;
  /// Scale of the last weakened output, in [0, 1].
  double weakened_to() const;

 private:
  class LivePlant;

  LiveSession(const RigExperiment& on, const std::string& name, std::unique_ptr<Plant> owned,
              LivePlant* plant);

  LivePlant* plant_;  ///< owned by the session
};

}  // namespace microswarm
