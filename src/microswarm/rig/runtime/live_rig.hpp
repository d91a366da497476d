// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/runtime/coil_loop.hpp"
#include "microswarm/rig/runtime/map_looks.hpp"
#include "microswarm/rig/runtime/rig_meter.hpp"
#include "microswarm/rig/runtime/rig_priority.hpp"
#include "microswarm/rig/runtime/tick_schedule.hpp"
#include "microswarm/rig/watch/sight_monitor.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm::rig {

/// Listeners to a rig.
struct LiveRigListeners {
  /// Called in the coils' thread after each output; an exception from it is a fault.
  std::function<void(const CoilMoment&)> coils{};
  /// Called in the camera's thread for each frame, also before the clock starts.
  vision::FrameListener pictures{};
  /// Called in the rig's thread with the detections in a picture taken at `seen` [s].
  std::function<void(const Detections&, double seen)> detections{};
};

/// A rig in real time. Each tick processes the newest frame, sends the command to the coils, and
/// waits for the next tick, see TickSchedule. On any fault (SafetyParams, a failing camera or coil
/// driver) the coils are set to zero permanently and `fault` gives the reason. Unless the camera is
/// simulated, the scenario's obstacles are virtual: they are observed together with the bodies that
/// the camera sees, as in the experiments of [radar] (Section V).
class LiveRig : public Plant {
 public:
  /// `rig` and `driver` must outlive the plant. `scale` maps camera pixels to the world. Waits for
  /// the first frame. Throws HardwareError if there is none, InputError if rig and scenario do not
  /// fit.
  LiveRig(const experiment::Scenario& scenario, std::shared_ptr<const Map> map, const Rig& rig,
          std::unique_ptr<vision::FrameSource> camera, const vision::CameraScale& scale,
          actuation::CoilDriver& driver, LiveRigListeners listeners = {});

  /// Sets the temperatures of the coils [°C], before the first command.
  void warm(const Eigen::VectorXd& temperatures) { controller_.warm(temperatures); }
  vision::NewestFrame& camera() { return camera_; }
  /// Sets the frequency of the field [Hz], see FieldGenerator::set_frequency.
  void set_field_frequency(double frequency) { coils_.set_frequency(frequency); }
  Observation observe() override;
  void apply(const Command& command, double dt) override;
  /// Replaces the virtual obstacles; false if the rig cannot have any.
  bool set_obstacles(const std::vector<Obstacle>& obstacles) override;
  std::string_view fault() const override { return fault_.why; }
  FaultKind fault_kind() const { return fault_.kind; }
  /// Whether the swarm did not follow its commands.
  bool lost_following() const { return sight_.lost_following(); }

  /// Sets the coils to zero permanently; callable from any thread. A tick in progress ends with its
  /// picture, at most one camera period later. Returns the report of the first stop.
  /// A stop of the kind `none` is no fault.
  actuation::StopReport stop(const std::string& why, FaultKind kind = FaultKind::person) {
    return coils_.stop(why, kind);
  }
  /// Zero of the record's time [s], by steady_seconds().
  double start() const { return start_; }
  RigTiming timing() const;
  DeviceEvents device_events() const { return meter_.device_events(); }
  /// Load of the coils relative to their limits.
  CoilLoad load() const { return meter_.load(); }
  /// Age of the newest processed picture [s].
  double frame_age() const { return since_start() - seen_; }
  /// The newest picture, its scale and its detections.
  const formats::Image& picture() const { return grey_; }
  const vision::CameraScale& scale() const { return scale_; }
  const Detections& detections() const { return *detections_; }
  /// Place of the map in the first picture.
  const PictureFit& first_fit() const { return first_fit_; }
  /// State of the pictures: light, focus, map, unseen swarms.
  PictureState picture_state() const { return sight_.watch().state(); }
  /// Notes about the pictures that came up since the last call, one line each.
  std::vector<std::string> take_notes() { return sight_.watch().take_notes(); }
  /// Times of the looks at the map so far [s].
  Durations look_times() const { return looks_->times(); }

 private:
  void look_at_map();
  void take_frame();
  void read_frame();
  Snapshot world_then() const;
  void look_for_faults(double now);
  void fail(const std::string& why, FaultKind kind);
  double since_start() const { return steady_seconds() - start_; }

  const RigPriority priority_;  // first member: the threads of the others inherit it
  const Rig& rig_;
  const bool has_virtual_;  // whether there are virtual obstacles
  World world_;             // map and virtual obstacles
  vision::CameraScale scale_;
  TickSchedule schedule_;
  vision::NewestFrame camera_;
  actuation::CoilController controller_;
  SightMonitor sight_;
  std::shared_ptr<PictureRegistration> registration_;
  PictureFit first_fit_;
  std::unique_ptr<MapLooks> looks_;
  double look_due_ = 0;  // [s]
  std::unique_ptr<Perception> perception_;
  vision::LiveFrame frame_;
  formats::Image grey_;
  LiveRigListeners listeners_;
  double reported_ = -1;  // time of the newest frame whose detections were reported [s]
  Detections unseen_;     // before the first picture
  const Detections* detections_ = &unseen_;
  double start_;      // [s], by steady_seconds()
  double seen_ = 0;   // time of the newest frame [s]
  double begun_ = 0;  // start of the tick [s]
  int missed_in_a_row_ = 0;
  Fault fault_;
  RigMeter meter_;
  CoilLoop coils_;  // last member, since its thread uses the others
};

}  // namespace microswarm::rig
