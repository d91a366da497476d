// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>

#include "microswarm/core/execution/durations.hpp"
#include "microswarm/rig/runtime/coil_load.hpp"
#include "microswarm/rig/runtime/coil_loop.hpp"
#include "microswarm/rig/watch/follow_monitor.hpp"

namespace microswarm::rig {

/// Durations and counts of a run on a rig.
struct RigTiming {
  Durations frame_age{};          ///< of the newest frame at the start of a tick
  Durations vision{};             ///< processing of a frame
  Durations tick{};               ///< from a tick's start to its command
  Durations camera_to_current{};  ///< from a picture to the first currents that answer it
  Durations coil_late{};          ///< delay of currents after their due time
  Durations round_trip{};         ///< of the coil driver's exchanges
  double sent_for = 0;            ///< from the first currents to the last [s]
  int resumed = 0;                ///< times the coils had switched off by themselves
  int unmade = 0;                 ///< fields that the coils cannot produce
  int limited = 0;                ///< fields weakened by the coils' limits
  double min_scale = 1;           ///< minimum scale of these
  int scaled = 0;                 ///< currents reduced by the device's own limits
  double min_device_scale = 1;    ///< minimum scale of these
  int missed_deadlines = 0;       ///< ticks that ended too late, see TickSchedule
  int late_currents = 0;          ///< pictures whose currents came more than a tick later
  int frames = 0;                 ///< frames processed
  int dropped_frames = 0;         ///< frames received but not processed
  int frame_gaps = 0;             ///< times the camera left out a frame, or was late by one
  int unseen_frames = 0;          ///< frames processed in which robots were unseen
  int max_unseen = 0;             ///< maximum number of unseen robots in a frame
  std::optional<FollowDirection> direction{};  ///< of the swarm relative to its commands

  /// Mean rate of currents while they were sent [Hz]; 0 for fewer than two.
  double sent_rate() const {
    return sent_for > 0 ? static_cast<double>(round_trip.count() - 1) / sent_for : 0;
  }
};

/// Actions of the coils' device by itself.
struct DeviceEvents {
  int resumed = 0;   ///< times the coils had switched off
  int scaled = 0;    ///< currents reduced by the device's own limits
  double scale = 1;  ///< scale of the last of these
};

/// Measures a run on a rig. Its methods may be called from any thread.
class RigMeter {
 public:
  /// `system` must outlive the meter. `tick`: of the scenario [s].
  RigMeter(const actuation::CoilSystem& system, double tick) : tick_(tick), load_(system) {}

  /// Adds an output to the coils.
  void add_output(const CoilMoment& moment);
  /// Adds a picture: time of its processing [s], robots that it does not show, direction of the
  /// swarm by all pictures.
  void add_picture(double vision, int unseen, const std::optional<FollowDirection>& direction);
  /// Adds the age of the newest frame [s] at the start of a tick.
  void add_frame_age(double age);
  /// Adds a tick: time from its start to its command [s], and whether it ended too late.
  void add_tick(double seconds, bool missed);

  /// The measurements so far, apart from the dropped frames and the gaps, which the camera counts.
  RigTiming timing() const;
  DeviceEvents device_events() const;
  /// Load of the coils relative to their limits.
  CoilLoad load() const;

 private:
  const double tick_;  // [s]
  mutable std::mutex mutex_;
  RigTiming timing_;
  double device_scale_ = 1;      // of the last currents that the device reduced
  std::optional<double> first_;  // time of the first output [s]
  double answered_ = 0;          // arrival of the newest picture with acknowledged currents [s]
  CoilLoadMeter load_;
};

}  // namespace microswarm::rig
