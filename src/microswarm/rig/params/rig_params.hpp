// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/drivers/line_coil_driver.hpp"
#include "microswarm/actuation/drivers/serial_coil_driver.hpp"
#include "microswarm/actuation/drivers/simulated_coil_driver.hpp"
#include "microswarm/actuation/field/field_generator.hpp"
#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/rig/params/microscope_params.hpp"
#include "microswarm/rig/params/perception_params.hpp"
#include "microswarm/vision/camera/camera.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"

namespace microswarm::rig {

/// Simulated microscope that draws the scenario's world.
struct SimulatedCamera {
  static constexpr std::string_view type_name = "simulated";
  MicroscopeParams microscope{};
  double rate = 60;
  double speed_error = 0;
  double direction_error = 0;
  double delay_error = 0;
  std::optional<double> step_out_frequency{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.microscope, plain("microscope", "Properties of the simulated images."));
    visit(self.rate, hz("rate", 0.1, 1000, "Frame rate of a run in real time."));
    visit(self.speed_error,
          plain("speed_error", -0.9, 10, "Relative excess of the swarm's speed over the model."));
    visit(self.direction_error,
          deg("direction_error", -180, 180, "Angle of the swarm's motion against the model's."));
    visit(self.delay_error,
          s("delay_error", 0, 10, "Delay of the swarm's motion beyond the model's."));
    visit(self.step_out_frequency, hz("step_out_frequency", 1e-6, 1e4,
                                      "The swarm's step-out frequency; none: the model's."));
  }
};

/// A video played at its own rate in place of a camera, for tests.
struct VideoCamera {
  static constexpr std::string_view type_name = "video";
  std::string file{};
  std::optional<double> rate{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.rate, hz("rate", 1e-3, 1e4, "Frame rate; none: that of the file."));
    visit(self.file, plain("file", "Video, folder or TIFF, beside the rig's file.").needed());
  }
};

/// Conditions that end a run for safety, with the coils at zero.
struct SafetyParams {
  double lost_swarm = 0.5;
  double max_frame_age = 0.5;
  std::optional<double> deadman{};
  int missed_deadlines = 10;
  int max_trips = 1;
  double trip_window = 10;
  double max_pause = 0.3;
  std::optional<double> follow_distance{};
  double min_follow_share = 0.25;
  double max_follow_share = 2.5;
  double max_map_shift_px = 5;
  double max_light_change = 0.5;
  double min_focus = 0.4;
  double max_unseen_share = 0.5;
  double frozen_swarm = 0.8;
  bool require_commissioning = false;
  std::vector<std::string> on_fault{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.lost_swarm,
          s("lost_swarm", 0.01, 100, "Longest time without exactly one visible swarm."));
    visit(self.max_frame_age, s("max_frame_age", 0.01, 100, "Maximum age of the newest frame.")
                                  .formerly("oldest_frame_s"));
    visit(self.deadman,
          s("deadman", 0.02, 100, "Longest time without a new command; none: 0.5 s, or 2 ticks."));
    visit(self.missed_deadlines,
          plain("missed_deadlines", 1, 1e6, "Maximum number of consecutive late ticks."));
    visit(self.max_trips,
          plain("max_trips", 0, 1000, "Times the device may be armed again in `trip_window_s`."));
    visit(self.trip_window, s("trip_window", 0.1, 1e5, "Time for which such a trip counts."));
    visit(self.max_pause, s("max_pause", 0.05, 100, "Longest standstill of program or computer."));
    visit(self.follow_distance, um("follow_distance", 1e-3, 1e6,
                                   "Distance that the swarm must follow; none: by its size."));
    visit(self.min_follow_share,
          plain("min_follow_share", 0, 1, "Share of it that must be seen; 0: not checked."));
    visit(self.max_follow_share,
          plain("max_follow_share", 0, 100, "Share of it that may be seen; 0: any."));
    visit(self.max_map_shift_px,
          px("max_map_shift", 0, 1e4, "Displacement of the map in the picture; 0: any."));
    visit(self.max_light_change,
          plain("max_light_change", 0, 0.99, "Share by which the light may change; 0: any."));
    visit(self.min_focus,
          plain("min_focus", 0, 1, "Sharpness relative to the start; 0: not checked."));
    visit(self.max_unseen_share,
          plain("max_unseen_share", 0, 1, "Share of pictures without the swarm; 0: any."));
    visit(self.frozen_swarm,
          s("frozen_swarm", 0, 100, "Time without a change at a driven swarm; 0: any."));
    visit(self.require_commissioning,
          plain("require_commissioning", "Refuse a run unless all was measured."));
    visit(self.on_fault, plain("on_fault", "Program and its arguments, started after a fault."));
  }
};

/// Every kind of coil driver. A new kind is its own files and an entry here. Each says its
/// `full_scale` [A], whether it `is_device`, its `input()`, its `channel_count(coils)`, what is
/// wrong with it at a drive rate, `validate(rate)`, and how a driver is opened, `open(site)`.
using CoilDriverParams =
    std::variant<actuation::SimulatedCoils, actuation::SerialCoilParams,
                 actuation::ProgramDriverParams, actuation::SocketDriverParams>;

/// Contents of a rig file: camera, coils, and the processing between them.
struct RigParams {
  std::string name{};
  std::string coils{};
  actuation::FieldGeneratorParams field{};
  double delay = 0;
  double drive_rate = 200;
  int realtime_priority = 0;
  CoilDriverParams driver{};
  std::variant<SimulatedCamera, vision::CameraParams, vision::GenicamParams, VideoCamera> camera{};
  std::optional<vision::CameraScale> scale{};
  PerceptionParams perception{};
  bool virtual_obstacles = true;
  SafetyParams safety{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the rig."));
    visit(self.coils, plain("coils", "File of the coil system, beside this one.").needed());
    visit(self.field, plain("field", "Conversion of commands to a magnetic field."));
    visit(self.delay, s("delay", 0, 10, "Time from a command to the motion that it causes."));
    visit(self.drive_rate,
          hz("drive_rate", 20, 1e4, "Rate of current updates; at least 10 per field turn."));
    visit(self.realtime_priority,
          plain("realtime_priority", 0, 98, "Priority of camera, ticks and coils; 0: as others."));
    visit(self.driver, plain("driver", "Device that drives the coils."));
    visit(self.camera, plain("camera", "Camera."));
    visit(self.scale, plain("scale", "Camera position and scale; not for a simulated camera."));
    visit(self.perception,
          plain("perception", "Detection of swarm, robots and obstacles.").formerly("eye"));
    visit(self.virtual_obstacles,
          plain("virtual_obstacles", "Add the scenario's obstacles to those a real camera sees."));
    visit(self.safety, plain("safety", "Limits that end a run."));
  }
};

/// A rig file with the coil system it names.
struct Rig {
  RigParams params{};
  actuation::CoilSystem system;
  std::filesystem::path folder{};  ///< of the file
  KeyLocations keys{};             ///< of the file
  /// Whether the coil system's file limits the current of every coil, apart from the driver's full
  /// scale.
  bool limits_current = false;
  std::filesystem::path file{};  ///< the rig's file
};

/// Current of a channel at full output [A].
double driver_full_scale(const RigParams& rig);

/// Channels of the rig's driver, as many as the system has coils unless it says otherwise.
int channel_count(const RigParams& rig, const actuation::CoilSystem& system);

/// Longest time without a new command of a navigator with this tick [s]. Throws InputError if the
/// rig's file names one that is shorter than two ticks.
double deadman(const Rig& rig, double tick);

/// Input of the rig's driver.
actuation::CoilInput coil_input(const RigParams& rig);

/// Origin of a rig's pictures: drawn from the simulated world, a camera, or a recording.
enum class CameraKind { simulated, device, video };
CameraKind camera_kind(const RigParams& rig);

/// The rig's camera if it is a device; nothing for a simulated one or a video.
std::optional<vision::AnyCameraParams> device_camera(const RigParams& rig);
/// Rate that the file asks of a camera that is a device [Hz]; empty if it leaves it as it is.
std::optional<double> asked_camera_rate(const RigParams& rig);
/// Whether the camera shows a simulated swarm: a simulated camera, Aravis's included.
bool shows_drawn_swarm(const RigParams& rig);
/// Detection of a silent, frozen or black camera of the rig.
vision::NewestFrameParams camera_watch(const RigParams& rig);

/// Name of the rig in records.
std::string rig_name(const Rig& rig);

/// Reads a rig file and its coil system, whose currents are limited by the driver's full scale.
/// `settings` are `key=value` texts, as from --set. Throws a one-line InputError, also if the drive
/// rate is too low for the field or the driver has too few channels.
Rig read_rig(const std::filesystem::path& file, const Settings& settings = {});

/// Whether the rig's coils are driven by a device, not simulated.
bool has_coil_device(const Rig& rig);

/// The rig's camera for a simulation. Throws InputError if it is not a simulated one.
const SimulatedCamera& simulated_camera(const Rig& rig);

/// Reports an issue if the rig cannot drive the scenario's swarm at its speed; keys are the
/// scenario's.
Issues validate(const Rig& rig, const experiment::Scenario& scenario);

/// Warning if the papers drive the scenario's kind of swarm with another kind of field than this
/// rig's, or if a rolling field turns too slowly for its commands; empty otherwise.
std::string unusual_field(const Rig& rig, const experiment::Scenario& scenario);

}  // namespace microswarm::rig

namespace microswarm {

/// Compiled once, in rig_params.cpp; describes the whole rig.
extern template const Type& type_of<rig::RigParams>();

}  // namespace microswarm
