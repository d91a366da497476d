// SPDX-License-Identifier: Apache-2.0
// `rig drive` drives currents or a field manually.
#include <fmt/ranges.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/rig/runtime/manual_drive.hpp"
#include "rig/keys/rig_keys.hpp"
#include "rig/real_coils.hpp"
#include "rig/rig.hpp"
#include "rig/rig_settings.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

struct DriveOptions {
  std::string rig;
  std::vector<std::string> settings;
  std::string currents;
  std::string field;
  std::optional<double> heading;
  double speed = 0;
  std::optional<double> each;
  double seconds = 5;
  double ramp = 0.5;
  CoilOptions coils;
};

std::string field_text(const Eigen::Vector3d& field) {
  const double whole = field.norm();
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mT", tidy(field[0], whole), tidy(field[1], whole),
                     tidy(field[2], whole));
}

/// Warns of currents reduced by the device's own limits; names the field unless it turns.
void note_device_limits(const rig::Rig& rig, const rig::ManualCommand& command,
                        const rig::ManualResult& result) {
  const std::string left =
      std::visit(Overloaded{[](const microswarm::Command&) { return std::string(); },
                            [&](const OneOf<Eigen::VectorXd, Eigen::Vector3d> auto&) {
                              const Eigen::Vector3d field =
                                  rig.system.at(rig.system.centre()).field * result.most;
                              return fmt::format(": at most {:.3g} A, {} more at the centre",
                                                 fmt::join(result.most, ", "), field_text(field));
                            }},
                 command.wanted);
  note("note: the device weakened the currents to {:.3g} %{}\n", 100 * result.min_device_scale,
       left);
}

/// Throws InputError for currents that the amplifiers cannot make at any coil temperature.
void require_possible(const Eigen::VectorXd& currents, const actuation::CoilSystem& system,
                      std::string_view option) {
  constexpr double unlimited = 1e9;  // [A]
  std::vector<actuation::AmplifierParams> cold = system.amplifiers();
  for (actuation::AmplifierParams& amplifier : cold) amplifier.max_temperature.reset();
  for (Eigen::Index k = 0; k < currents.size(); ++k) {
    const Eigen::VectorXd alone = unlimited * Eigen::VectorXd::Unit(currents.size(), k);
    const double most = actuation::Amplifiers(cold).steady(alone).currents[k];
    if (std::abs(currents[k]) > most * (1 + 1e-9))
      throw InputError(fmt::format("{}: coil {} can carry {:.4g} A, not {:.6g} A", option,
                                   quote(system.coil_names()[static_cast<std::size_t>(k)]), most,
                                   currents[k]));
  }
}

/// Throws InputError for a command that the rig cannot execute.
void require_possible(const rig::ManualCommand& command, const rig::RigParams& rig,
                      const actuation::CoilSystem& system) {
  const auto check_currents = [&](const Eigen::VectorXd& currents) {
    require_possible(currents, system, "--currents");
  };
  const auto check_field = [&](const Eigen::Vector3d& field) {
    if (!actuation::currents_for(system.at(system.centre()), field).reached)
      throw InputError("--field: the coils cannot make this field, see `microswarm rig field`");
  };
  const auto check_steering = [&](const microswarm::Command& steering) {
    const double most = rig.field.max_speed();
    if (steering.speed > most * (1 + 1e-9))
      throw InputError(
          fmt::format("--speed: the rig's field moves a swarm at {:.4g} µm/s at most, "
                      "not {:.6g} µm/s",
                      most, steering.speed));
  };
  std::visit(Overloaded{check_currents, check_field, check_steering}, command.wanted);
}

/// Drives the coils and reports the result. Returns the exit code.
int drive(Bench& bench, const rig::ManualCommand& command, const Context& context) {
  std::atomic<bool> pressed = false;
  const RigKeys keys([&] { pressed = true; }, {}, context.stop);
  if (bench.kept && !std::exchange(bench.said_how_to_stop, true))
    note_how_to_stop(keys.are_there(), "");
  std::optional<ProgressBar> bar("drive");
  const auto listener = [&](const rig::ManualMoment& moment) {
    bench.temperatures = moment.output.temperatures;
    if (bench.kept) bench.kept->take(bench.temperatures);
    if (pressed) throw HardwareError("the emergency key was pressed");
    bar->update(moment.t / command.seconds,
                fmt::format("{:.3g} A", fmt::join(moment.output.acknowledged, ", ")));
  };
  const rig::ManualResult result = rig::drive_by_hand(bench.rig, *bench.driver, command,
                                                      bench.temperatures, listener, context.stop);
  bar.reset();
  if (bench.kept) bench.kept->take(result.zero);
  if (!result.why.empty()) note("microswarm: {}\n", result.why);
  const bool at_zero = note_zero(result.zero);
  if (result.min_scale < 1 - 1e-9)
    note("note: the coils' limits weakened this to {:.0f} %\n", 100 * result.min_scale);
  if (result.min_device_scale < 1 - 1e-9) note_device_limits(bench.rig, command, result);
  if (result.status == Status::fault || !at_zero) return hardware;
  return result.status == Status::stopped ? not_reached : ok;
}

/// Drives one coil after the other, so that a compass or a probe shows polarity and channel.
int drive_each(Bench& bench, const DriveOptions& o, const Context& context) {
  const actuation::Actuation actuation = bench.rig.system.at(bench.rig.system.centre());
  for (std::size_t k = 0; k < bench.rig.system.size(); ++k) {
    Eigen::VectorXd currents = Eigen::VectorXd::Zero(bench.temperatures.size());
    currents[static_cast<Eigen::Index>(k)] = *o.each;
    print("coil {}, channel {}: {:.4g} A, expect {} more at the centre\n",
          bench.rig.system.coil_names()[k], k + 1, *o.each, field_text(actuation.field * currents));
    flush_output();
    const int code = drive(bench, {currents, o.seconds, o.ramp}, context);
    if (code != ok) return code;
  }
  return ok;
}

rig::ManualCommand to_command(const DriveOptions& o, const actuation::CoilSystem& system) {
  rig::ManualCommand command{.wanted = {}, .seconds = o.seconds, .ramp = o.ramp};
  if (!o.currents.empty())
    command.wanted = parse_currents(o.currents, system);
  else if (!o.field.empty())
    command.wanted = parse_triple(o.field);
  else
    command.wanted = microswarm::Command{radians(*o.heading), o.speed};
  return command;
}

int rig_drive(const DriveOptions& o, const Context& context) {
  const int kinds =
      !o.currents.empty() + !o.field.empty() + o.heading.has_value() + o.each.has_value();
  if (kinds != 1) throw InputError("rig drive: give one of --currents, --field, --heading, --each");
  if (2 * o.ramp > o.seconds)
    throw InputError(fmt::format("--ramp: two ramps of {:.6g} s are longer than --seconds {:.6g}",
                                 o.ramp, o.seconds));
  const rig::Rig rig = reading([&] { return rig::read_rig(o.rig, {o.settings, "--set"}); });
  if (coil_input(rig.params) == actuation::CoilInput::field && (o.each || !o.currents.empty()))
    throw InputError("--currents and --each are for a driver that is sent currents: give --field");
  if (o.each) {
    if (*o.each == 0) throw InputError("--each: 0 A shows nothing of a coil");
    const auto coils = static_cast<Eigen::Index>(rig.system.size());
    require_possible(Eigen::VectorXd::Constant(coils, *o.each), rig.system, "--each");
    Bench bench(rig, o.coils);
    return drive_each(bench, o, context);
  }
  const rig::ManualCommand command = to_command(o, rig.system);
  require_possible(command, rig.params, rig.system);
  Bench bench(rig, o.coils);
  return drive(bench, command, context);
}

}  // namespace

void add_rig_drive(Command rig, Action& action) {
  auto o = std::make_shared<DriveOptions>();
  Command cmd = rig.add_command("drive", "Drive the coils by hand: currents, a field, or each coil",
                                "rig drive scenarios/rigs/vortex.yaml --field 2,0,0 --seconds 5");
  cmd.add_option("rig", o->rig, "Rig file (YAML)").required().type_name("FILE").input("rigs");
  cmd.add_option("--currents", o->currents, "Current of each coil in A").type_name("A,A,...");
  cmd.add_option("--field", o->field, "Constant field at the centre in mT")
      .type_name("BX,BY,BZ")
      .check(triple("BX,BY,BZ", max_field));
  cmd.add_option("--heading", o->heading, "The rig's own field, with this heading in degrees")
      .type_name("DEG")
      .check(number(-360, 360));
  cmd.add_option("--speed", o->speed, "Speed for --heading in µm/s, by the field's calibration")
      .type_name("UM/S")
      .check(number(0, 1e6));
  cmd.add_option("--each", o->each, "One coil after the other with this current in A")
      .type_name("A")
      .check(number(-1e6, 1e6));
  cmd.add_option("--seconds", o->seconds, "Duration, of each coil with --each")
      .type_name("SECONDS")
      .check(number(0.1, 1e5));
  cmd.add_option("--ramp", o->ramp, "Time of each ramp").type_name("SECONDS").check(number(0, 1e4));
  add_coil_options(cmd, o->coils);
  add_rig_settings(cmd, "--set", o->settings);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return rig_drive(*o, context); }; });
}

}  // namespace microswarm::cli
