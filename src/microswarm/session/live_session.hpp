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
  bool dry = false;                ///< nothing is sent to the coils
  bool idle = false;               ///< in a dry run, a simulated swarm stays where it is
  std::filesystem::path folder{};  ///< of commands.csv; empty: the coil outputs are not logged
  std::filesystem::path video{};   ///< of the camera; empty: none
  bool without_limits = false;     ///< the coil system need not limit current and temperature
  bool coils_cold = false;         ///< the coils are at ambient temperature
  std::string note{};              ///< of the operator, kept in the record
};

/// Live numbers of a run on a rig.
struct LiveStatus {
  double t = 0;  ///< on the record's clock [s]
  NavigatorState state = NavigatorState::hold;
  bool holding = false;      ///< the goal was reached, and the swarm is held there
  double goal_distance = 0;  ///< [µm], infinite before the swarm was seen
  double command_speed = 0;  ///< [µm/s]
  double radius = 0;         ///< of the swarm [µm]
  double gap = infinity;     ///< from its edge to walls and obstacles [µm]; infinite for robots
  std::string_view trouble;  ///< why the swarm is not seen, see Detections; empty: it is seen
  int robots = 0;            ///< individually tracked robots
  int unseen = 0;            ///< of them
  CoilLoad coils;
  double frame_age = 0;      ///< of the newest picture [s]
  double tick_p95 = 0;       ///< time that 95 % of the ticks take at most [s]
  int missed_deadlines = 0;  ///< ticks that ended too late
};

/// A session on a rig in real time: a step takes as long as a tick. The destructor sets the coils
/// to zero.
class LiveSession : public Session {
 public:
  /// Checks and opens the rig's devices. Throws HardwareError if a device fails, InputError if rig
  /// and scenario do not fit, if the coils cannot hold the field, or if a limit is missing.
  static std::unique_ptr<LiveSession> open(const RigExperiment& on, const LiveOptions& options);

  /// One line for each weakness of the rig that was found when it was opened.
  const std::vector<std::string>& warnings() const;
  /// Sets the coils to zero for good; callable from any thread.
  void stop(const std::string& why);
  /// Sets the coils to zero after the last tick, finishes the log and gives the record what was
  /// driven and seen, up to 10,000,000 values of each. Returns the reason of a
  /// failure, or an empty string.
  std::string close();
  /// After stop(): the device confirmed that the coils are at zero.
  bool zero_is_confirmed() const;
  /// After stop(): why another than the driver that drove confirmed it, CoilDriver::stop_trouble.
  std::string stop_trouble() const;
  /// After close(): the recorded video, if one was asked for.
  std::optional<RecordedVideo> video() const;
  RigTiming timing() const;
  /// Numbers of the newest tick, in the thread that steps.
  LiveStatus status() const;
  /// The newest picture of the camera, grey, and where it shows the world; in the thread that
  /// steps.
  const Image& picture() const;
  const CameraScale& camera_scale() const;
  const Rig& rig() const;
  /// How often the coils had switched off by themselves so far.
  int resumed() const;
  /// How often the device's own limits weakened the currents so far.
  int weakened() const;
  /// What they left of the currents the last time, in [0, 1].
  double weakened_to() const;

 private:
  class LivePlant;

  LiveSession(const RigExperiment& on, const std::string& name, std::unique_ptr<Plant> owned,
              LivePlant* plant);

  LivePlant* plant_;  ///< owned by the session
};

}  // namespace microswarm
