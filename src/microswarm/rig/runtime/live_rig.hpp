// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/core/clock.hpp"
#include "microswarm/core/durations.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/runtime/coil_loop.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm {

/// How long the stages of a run took.
struct RigTiming {
  Durations frame_age;       ///< of the newest frame when a tick begins
  Durations vision;          ///< to read a picture
  Durations tick;            ///< from a tick's begin to its command
  Durations coil_late;       ///< currents after they were due
  Durations round_trip;      ///< of the coil driver
  int resumed = 0;           ///< times the coils had been off by themselves
  int unmade = 0;            ///< fields that these coils cannot make
  int limited = 0;           ///< fields that the coils' limits weakened
  double min_scale = 1;      ///< the weakest of them, as share of what was wanted
  int scaled = 0;            ///< currents that the device's own limits made smaller
  int missed_deadlines = 0;  ///< ticks that ended after the next should have begun
  int frames = 0;            ///< that were read
  int dropped_frames = 0;    ///< that came and were not
};

/// A rig in real time: the newest frame is read, the command goes to the coils, the next tick
/// begins when it is due. As soon as something is not as it should be (SafetyParams, a camera or a
/// coil driver that fails) the coils go to zero for good and `fault` says why.
class LiveRig : public Plant {
 public:
  /// The rig and the driver outlive it. `scale` is where the camera sees the world. `heard` is
  /// called in the coils' thread with whatever was sent; what it throws is a fault. Waits for the
  /// first frame; throws HardwareError when none comes, InputError when rig and scenario do not go
  /// together.
  LiveRig(const Scenario& scenario, std::shared_ptr<const Map> map, const Rig& rig,
          std::unique_ptr<FrameSource> camera, const CameraScale& scale, CoilDriver& driver,
          std::function<void(const CoilMoment&)> heard = {});

  Observation observe() override;
  void apply(const Command& command, double dt) override;
  std::string_view fault() const override { return fault_; }

  /// Coils to zero, for good; from any thread. The tick that is waited for ends at once.
  void stop(const std::string& why);
  /// After stop(): the device said that the coils are at zero.
  bool zero_is_confirmed() const { return coils_.zero_is_confirmed(); }
  /// After stop(): when the device was told so [s], by steady_seconds().
  double zero_at() const { return coils_.zero_at(); }
  RigTiming timing() const;
  /// The newest picture and what was seen in it.
  const Image& picture() const { return grey_; }
  const Detections& sight() const { return *detections_; }

 private:
  void take_frame();
  void read_frame();
  void look_for_faults(double now);
  void fail(const std::string& why);
  double since_start() const { return steady_seconds() - start_; }

  const Rig& rig_;
  std::shared_ptr<const Map> map_;
  NewestFrame camera_;
  CoilController controller_;
  std::unique_ptr<Perception> perception_;
  LiveFrame frame_;
  Image grey_;
  Detections unseen_;  // before the first picture
  const Detections* detections_ = &unseen_;
  double start_;      // [s], by steady_seconds()
  double seen_ = 0;   // when the newest frame was taken [s]
  double found_ = 0;  // when the swarm was seen last [s]
  double begun_ = 0;  // the tick [s]
  double next_ = 0;   // when the next one begins [s]
  int missed_in_a_row_ = 0;
  std::string fault_;
  mutable std::mutex timing_mutex_;
  RigTiming timing_;
  CoilLoop coils_;  // last: its thread uses what is above
};

}  // namespace microswarm
