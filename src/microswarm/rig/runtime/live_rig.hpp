// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/execution/durations.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/runtime/coil_load.hpp"
#include "microswarm/rig/runtime/coil_loop.hpp"
#include "microswarm/rig/runtime/follow_monitor.hpp"
#include "microswarm/rig/runtime/tick_schedule.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm {

/// Durations and counts of a run on a rig.
struct RigTiming {
  Durations frame_age;                         ///< of the newest frame at the start of a tick
  Durations vision;                            ///< image processing of a frame
  Durations tick;                              ///< from the start of a tick to its command
  Durations camera_to_current;                 ///< from a picture to the first currents for it
  Durations coil_late;                         ///< delay of currents after their due time
  Durations round_trip;                        ///< of the coil driver
  int resumed = 0;                             ///< times the coils had switched off by themselves
  int unmade = 0;                              ///< fields that the coils cannot produce
  int limited = 0;                             ///< fields weakened by the coils' limits
  double min_scale = 1;                        ///< minimum scale of these
  int scaled = 0;                              ///< currents reduced by the device's own limits
  double min_device_scale = 1;                 ///< minimum scale of these
  int missed_deadlines = 0;                    ///< ticks that ended too late, see TickSchedule
  int late_currents = 0;                       ///< pictures with currents more than a tick later
  int frames = 0;                              ///< processed
  int dropped_frames = 0;                      ///< received but not processed
  int unseen_frames = 0;                       ///< processed, in which robots were unseen
  int most_unseen = 0;                         ///< robots that were unseen in one frame
  std::optional<FollowDirection> direction{};  ///< of the swarm relative to its commands
};

/// A rig in real time. Each tick processes the newest frame, sends the command to the coils, and
/// waits for the next tick, see TickSchedule. On any fault (SafetyParams, a failing camera or coil
/// driver) the coils go to zero for good and `fault` gives the reason. Unless the camera is
/// simulated, the scenario's obstacles are virtual: observed with the bodies that the camera sees,
/// as in the experiments of [radar] (Section V).
class LiveRig : public Plant {
 public:
  /// `rig` and `driver` must outlive it. `scale` maps camera pixels to the world. `heard` is called
  /// in the coils' thread after each output; an exception from it is a fault. `pictures` is called
  /// in the camera's thread for each frame, also before the clock starts. Waits for the first
  /// frame. Throws HardwareError if there is none, InputError if rig and scenario do not fit.
  LiveRig(const Scenario& scenario, std::shared_ptr<const Map> map, const Rig& rig,
          std::unique_ptr<FrameSource> camera, const CameraScale& scale, CoilDriver& driver,
          std::function<void(const CoilMoment&)> heard = {}, FrameListener pictures = {});

  /// Sets the present temperatures of the coils [°C], before the first command.
  void warm(const Eigen::VectorXd& temperatures) { controller_.warm(temperatures); }
  NewestFrame& camera() { return camera_; }
  /// When the clock of its observations was zero [s], by steady_seconds().
  double clock_zero() const { return start_; }
  Observation observe() override;
  void apply(const Command& command, double dt) override;
  /// Replaces the virtual obstacles; false if there can be none.
  bool set_obstacles(const std::vector<Obstacle>& obstacles) override;
  std::string_view fault() const override { return fault_; }

  /// Sets the coils to zero for good; callable from any thread. A tick in progress ends with its
  /// picture, a period of the camera later at the most.
  void stop(const std::string& why);
  /// After stop(): the device confirmed that the coils are at zero.
  bool zero_is_confirmed() const { return coils_.zero_is_confirmed(); }
  /// After stop(): CoilDriver::stop_trouble.
  std::string stop_trouble() const { return coils_.stop_trouble(); }
  /// After stop(): when zero was commanded [s], by steady_seconds().
  double zero_at() const { return coils_.zero_at(); }
  /// When the record's time is 0 [s], by steady_seconds().
  double start() const { return start_; }
  RigTiming timing() const;
  /// How near the coils are to their limits.
  CoilLoad load() const;
  /// Age of the newest processed picture [s].
  double frame_age() const { return since_start() - seen_; }
  /// How often the coils had switched off by themselves so far.
  int resumed() const;
  /// How often the device's own limits weakened the currents so far.
  int weakened() const;
  /// What they left of the currents the last time, in [0, 1].
  double weakened_to() const;
  /// The newest picture, where it shows the world, and its detections.
  const Image& picture() const { return grey_; }
  const CameraScale& scale() const { return scale_; }
  const Detections& sight() const { return *detections_; }

 private:
  void hear(const CoilMoment& moment);
  void take_frame();
  void read_frame();
  Snapshot world_then() const;
  void look_for_faults(double now);
  void fail(const std::string& why);
  double since_start() const { return steady_seconds() - start_; }

  const Rig& rig_;
  const bool has_virtual_;  // obstacles
  World world_;             // map and virtual obstacles
  CameraScale scale_;
  const double tick_;  // [s]
  TickSchedule schedule_;
  NewestFrame camera_;
  CoilController controller_;
  FollowMonitor following_;
  FollowAngle angle_;
  std::unique_ptr<Perception> perception_;
  LiveFrame frame_;
  Image grey_;
  Detections unseen_;  // before the first picture
  const Detections* detections_ = &unseen_;
  double start_;      // [s], by steady_seconds()
  double seen_ = 0;   // time of the newest frame [s]
  double found_ = 0;  // when the swarm was last detected [s]
  double begun_ = 0;  // start of the tick [s]
  int missed_in_a_row_ = 0;
  std::string fault_;
  mutable std::mutex timing_mutex_;
  RigTiming timing_;
  double driven_for_ = 0;   // when the picture came that the currents are for [s]; likewise
  double weakened_to_ = 1;  // with the timing's mutex
  CoilLoadMeter load_;      // with the timing's mutex
  CoilLoop coils_;          // last member: its thread uses the others
};

}  // namespace microswarm
