// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/drivers/serial_coil_driver.hpp"
#include "microswarm/actuation/field/field_generator.hpp"
#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/core/fields.hpp"
#include "microswarm/core/issue.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/rig/params/microscope_params.hpp"
#include "microswarm/rig/params/perception_params.hpp"
#include "microswarm/vision/camera/camera.hpp"
#include "microswarm/vision/camera/camera_scale.hpp"

namespace microswarm {

/// Coils that are not there: any current up to the full scale is taken.
struct SimulatedCoils {
  static constexpr std::string_view type_name = "simulated";
  int channels = 6;
  double full_scale = 20;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.channels, {"channels", Unit::none, {1, 64}, "Number of coil channels."});
    visit(self.full_scale,
          {"full_scale", Unit::a, {1e-6, 1e6}, "Current of a channel at full output."});
  }
};

/// A microscope that is not there: it draws the scenario's world.
struct SimulatedCamera {
  static constexpr std::string_view type_name = "simulated";
  MicroscopeParams microscope;
  double speed_error = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.microscope, {"microscope", Unit::none, {}, "Properties of the simulated images."});
    visit(self.speed_error, {"speed_error",
                             Unit::none,
                             {-0.9, 10},
                             "Relative excess of the swarm's speed over the model."});
  }
};

/// A video in place of a camera, at its own pace; for trying things out.
struct VideoCamera {
  static constexpr std::string_view type_name = "video";
  std::string file;
  std::optional<double> rate;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.rate, {"rate", Unit::hz, {1e-3, 1e4}, "Frame rate; none: that of the file."});
    visit(self.file,
          {"file", Unit::none, {}, "Video, folder or TIFF, beside the rig's file.", true});
  }
};

/// When a run is ended for safety, with the coils at zero.
struct SafetyParams {
  double lost_swarm = 0.5;
  double max_frame_age = 0.5;
  double deadman = 0.5;
  int missed_deadlines = 10;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.lost_swarm,
          {"lost_swarm", Unit::s, {0.01, 100}, "Longest time without exactly one visible swarm."});
    visit(self.max_frame_age, {"max_frame_age",
                               Unit::s,
                               {0.01, 100},
                               "Maximum age of the newest frame.",
                               false,
                               "oldest_frame_s"});
    visit(
        self.deadman,
        {"deadman", Unit::s, {0.02, 100}, "Longest time without a new command of the navigator."});
    visit(self.missed_deadlines,
          {"missed_deadlines", Unit::none, {1, 1e6}, "Maximum number of consecutive late ticks."});
  }
};

/// A file of a rig: camera, coils, and what is between them.
struct RigParams {
  std::string name;
  std::string coils;
  FieldGeneratorParams field;
  double drive_rate = 200;
  std::variant<SimulatedCoils, SerialCoilParams> driver;
  std::variant<SimulatedCamera, CameraParams, VideoCamera> camera;
  std::optional<CameraScale> scale;
  PerceptionParams perception;
  SafetyParams safety;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, {"name", Unit::none, {}, "Name of the rig."});
    visit(self.coils, {"coils", Unit::none, {}, "File of the coil system, beside this one.", true});
    visit(self.field, {"field", Unit::none, {}, "Conversion of commands to a magnetic field."});
    visit(self.drive_rate, {"drive_rate",
                            Unit::hz,
                            {20, 1e4},
                            "Rate of current updates; at least 10 per field turn."});
    visit(self.driver, {"driver", Unit::none, {}, "Device that drives the coils."});
    visit(self.camera, {"camera", Unit::none, {}, "Camera."});
    visit(self.scale,
          {"scale", Unit::none, {}, "Camera position and scale; not for a simulated camera."});
    visit(
        self.perception,
        {"perception", Unit::none, {}, "Detection of swarm, robots and obstacles.", false, "eye"});
    visit(self.safety, {"safety", Unit::none, {}, "Limits that end a run."});
  }
};

/// A rig's file and what it names.
struct Rig {
  RigParams params;
  CoilSystem system;
  std::filesystem::path folder;  ///< of the file
  KeyLocations keys;             ///< of the file
};

/// What it is called in records.
std::string name_of(const Rig& rig);

/// Reads the file of a rig and its coil system, whose currents the driver's full scale limits;
/// `settings` are `key=value` texts as from --set.
/// Throws InputError in one line, also for currents that are sent too seldom for the field and for
/// a driver with too few channels.
Rig read_rig(const std::filesystem::path& file, const Settings& settings = {});

/// The rig's camera, for a simulation. Throws InputError when it is no simulated one.
const SimulatedCamera& simulated_camera(const Rig& rig);

/// An issue when the rig cannot drive the scenario's swarm as fast as it is meant to go; keys are
/// the scenario's.
Issues validate(const Rig& rig, const Scenario& scenario);

/// Says it when the scenario's swarm is driven by another kind of field in the papers than this
/// rig has, or when a rolling field turns too slowly for its commands; empty else.
std::string unusual_field(const Rig& rig, const Scenario& scenario);

}  // namespace microswarm
