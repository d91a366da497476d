// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/params/rig_params.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "microswarm/config/file_kind.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/input_folder.hpp"

namespace microswarm::rig {

namespace {

constexpr double min_sends = 10;            // per turn of the field
constexpr double max_waveform_sends = 100;  // [Hz]; one takes 8.0 ms at 115200 baud

/// The field that drives a kind of swarm in the papers.
struct UsualField {
  const char* swarm;
  actuation::FieldKind kind;
};

Issues validate(const RigParams& rig, const actuation::CoilSystem& system) {
  Issues issues;
  const bool on_device = coil_input(rig) == actuation::CoilInput::waveform;
  const double min_rate = min_sends * rig.field.frequency;
  constexpr double max_frequency = 1e-3 * actuation::coil_link_max_frequency;
  if (on_device && rig.drive_rate > max_waveform_sends)
    issues.add({"drive_rate_hz", "driver.waveforms"},
               fmt::format("drive_rate_hz is {:.6g}, the line carries at most {:g} waveforms a "
                           "second",
                           rig.drive_rate, max_waveform_sends));
  if (on_device && rig.field.frequency > max_frequency)
    issues.add({"field.frequency_hz", "driver.waveforms"},
               fmt::format("field.frequency_hz is {:.6g}, the device makes at most {:g}",
                           rig.field.frequency, max_frequency));
  if (!on_device && rig.drive_rate < min_rate)
    issues.add({"drive_rate_hz", "field.frequency_hz"},
               fmt::format("drive_rate_hz is {:.6g}, the field turns {:.6g} times a second and "
                           "needs at least {:.6g}",
                           rig.drive_rate, rig.field.frequency, min_rate));
  issues.add_within("perception.scene.swarm.look", validate(rig.perception.scene.swarm.look));
  issues.add_within("perception.scene.obstacles", validate(rig.perception.scene.obstacles));
  issues.add(
      std::visit([&](const auto& driver) { return driver.validate(rig.drive_rate); }, rig.driver));
  if (const auto& command = rig.safety.on_fault; !command.empty() && command.front().empty())
    issues.add({"safety.on_fault"}, "the program of safety.on_fault is empty");
  const int channels = channel_count(rig, system);
  if (static_cast<int>(system.size()) > channels)
    issues.add(
        {"driver.channels", "driver"},
        fmt::format("the system has {} coils, the driver {} channels", system.size(), channels));
  return issues;
}

}  // namespace

Rig read_rig(const std::filesystem::path& file, const Settings& settings) {
  KeyLocations keys;
  const std::string text = read_file(file, max_yaml_bytes);
  Issues misread;
  auto params = read_yaml_text<RigParams>(text, file.string(), settings, keys, misread);
  if (!misread.empty()) refuse_other_kind(text, file.string(), "rig");
  if (!misread.empty()) throw InputError(misread);
  actuation::CoilSystem system = actuation::read_coil_system(input_folder(file) / params.coils);
  keys.require_none(validate(params, system));
  const bool limits_current =
      std::ranges::all_of(system.amplifiers(), [](const actuation::AmplifierParams& amplifier) {
        return amplifier.max_current.has_value();
      });
  system.limit_current(driver_full_scale(params));
  return {std::move(params), std::move(system), input_folder(file), keys, limits_current, file};
}

double driver_full_scale(const RigParams& rig) {
  return std::visit([](const auto& driver) { return driver.full_scale; }, rig.driver);
}

int channel_count(const RigParams& rig, const actuation::CoilSystem& system) {
  return std::visit([&](const auto& driver) { return driver.channel_count(system.size()); },
                    rig.driver);
}

double deadman(const Rig& rig, double tick) {
  constexpr double usual = 0.5;  // [s]
  const double least = 2 * tick;
  const double longest = rig.params.safety.deadman.value_or(std::max(usual, least));
  if (longest < least)
    throw rig.keys.error(
        "safety.deadman_s",
        fmt::format("safety.deadman_s is {:.6g}, a tick of the scenario {:.6g} s: it must be at "
                    "least twice that",
                    longest, tick));
  return longest;
}

actuation::CoilInput coil_input(const RigParams& rig) {
  return std::visit([](const auto& driver) { return driver.input(); }, rig.driver);
}

CameraKind camera_kind(const RigParams& rig) {
  return std::visit(Overloaded{[](const SimulatedCamera&) { return CameraKind::simulated; },
                               [](const OneOf<vision::CameraParams, vision::GenicamParams> auto&) {
                                 return CameraKind::device;
                               },
                               [](const VideoCamera&) { return CameraKind::video; }},
                    rig.camera);
}

std::optional<vision::AnyCameraParams> device_camera(const RigParams& rig) {
  using Device = std::optional<vision::AnyCameraParams>;
  return std::visit(
      Overloaded{[](const OneOf<SimulatedCamera, VideoCamera> auto&) { return Device(); },
                 [](const OneOf<vision::CameraParams, vision::GenicamParams> auto& c) {
                   return Device(c);
                 }},
      rig.camera);
}

std::optional<double> asked_camera_rate(const RigParams& rig) {
  return std::visit(
      Overloaded{
          [](const OneOf<SimulatedCamera, VideoCamera> auto&) { return std::optional<double>(); },
          [](const OneOf<vision::CameraParams, vision::GenicamParams> auto& camera) {
            return std::optional<double>(camera.rate);
          }},
      rig.camera);
}

bool shows_drawn_swarm(const RigParams& rig) {
  return std::visit(
      Overloaded{[](const SimulatedCamera&) { return true; },
                 [](const vision::GenicamParams& genicam) { return vision::is_fake(genicam); },
                 [](const OneOf<vision::CameraParams, VideoCamera> auto&) { return false; }},
      rig.camera);
}

vision::NewestFrameParams camera_watch(const RigParams& rig) {
  const std::optional<vision::AnyCameraParams> camera = device_camera(rig);
  if (!camera) return {};
  return std::visit([](const auto& params) { return params.watch; }, *camera);
}

std::string rig_name(const Rig& rig) {
  return rig.params.name.empty() ? "unnamed rig" : rig.params.name;
}

bool has_coil_device(const Rig& rig) {
  return std::visit([](const auto& driver) { return driver.is_device; }, rig.params.driver);
}

const SimulatedCamera& simulated_camera(const Rig& rig) {
  const auto* camera = std::get_if<SimulatedCamera>(&rig.params.camera);
  if (!camera) throw rig.keys.error("camera", "the camera is not simulated: set camera.type");
  return *camera;
}

Issues validate(const Rig& rig, const experiment::Scenario& scenario) {
  Issues issues;
  const actuation::FieldGeneratorParams& field = rig.params.field;
  const double reach = field.max_speed();
  const double wanted =
      scenario.robots ? scenario.robots->max_speed : swarm_limits(scenario.swarm).max_speed;
  if (wanted > reach * (1 + 1e-9))
    issues.add({"robots.max_speed_um_per_s", "swarm.max_speed_um_per_s"},
               fmt::format("the swarm is meant to go {:.6g} µm/s, this rig's field drives it at "
                           "most {:.6g} µm/s",
                           wanted, reach));
  return issues;
}

std::string unusual_field(const Rig& rig, const experiment::Scenario& scenario) {
  const UsualField of_body =
      std::visit(Overloaded{[](const RibbonParams&) {
                              return UsualField{"a ribbon", actuation::FieldKind::oscillating};
                            },
                            [](const VortexParams&) {
                              return UsualField{"a vortex", actuation::FieldKind::rotating};
                            }},
                 scenario.swarm);
  const auto [swarm, usual] =
      scenario.robots ? UsualField{"robots", actuation::FieldKind::rolling} : of_body;
  const actuation::FieldKind kind = rig.params.field.kind;
  const double turn = pi / 2 / rig.params.field.max_turn_rate;
  if (kind == actuation::FieldKind::rolling && turn > scenario.tick)
    return fmt::format(
        "the rolling field takes {:.3g} s to turn by 90°, a command lasts {:.3g} s: "
        "robots lag behind at turns, see field.max_turn_rate_deg_per_s",
        turn, scenario.tick);
  if (kind == usual) return {};
  return fmt::format("{} under a field that is {}: in the papers it is {}", swarm, enum_name(kind),
                     enum_name(usual));
}

}  // namespace microswarm::rig

namespace microswarm {

template const Type& type_of<rig::RigParams>();

}  // namespace microswarm
