// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/manual_drive.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/actuation/coils/turning_currents.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/rig/runtime/device_limits.hpp"
#include "microswarm/rig/runtime/standstill.hpp"

namespace microswarm {
namespace {

/// Currents wanted at full share, as a function of time.
class Wanted {
 public:
  Wanted(const Rig& rig, const ManualCommand& command)
      : command_(command), actuation_(rig.system.at(rig.system.centre())) {
    std::visit(Overloaded{[&](const Command& steering) {
                            generator_.emplace(rig.params.field, steering.heading);
                            generator_->command(steering);
                          },
                          [](const OneOf<Eigen::VectorXd, Eigen::Vector3d> auto&) {}},
               command.wanted);
  }

  /// Advances by `dt` seconds and fills `output`.
  void advance(double dt, CoilOutput& output) {
    std::visit(Overloaded{[&](const Eigen::VectorXd& currents) {
                            output.wanted = actuation_.field_of(currents);
                            output.currents = currents;
                          },
                          [&](const Eigen::Vector3d& field) { make(field, output); },
                          [&](const Command&) { make(generator_->advance(dt), output); }},
               command_.wanted);
  }

  const Actuation& actuation() const { return actuation_; }
  bool turns() const { return generator_.has_value(); }
  /// `share` of the turning currents now, and whether the coils can produce the field.
  TurningCurrents turning(double share, bool& reached) const {
    TurningCurrents currents = turning_currents(actuation_, *generator_, reached);
    for (Eigen::VectorXd* part : {&currents.constant, &currents.cosine, &currents.sine})
      *part *= share;
    return currents;
  }
  void follow_phase(double phase) { generator_->follow_phase(phase); }

 private:
  void make(const Eigen::Vector3d& field, CoilOutput& output) const {
    const CurrentsForField found = currents_for(actuation_, field);
    output.wanted = field;
    output.currents = found.currents;
    output.reached = found.reached;
  }

  const ManualCommand& command_;
  Actuation actuation_;
  std::optional<FieldGenerator> generator_;
};

/// Share at `t` of a command that ends at `end`, with linear ramps of `ramp` [s].
double share_at(double t, double end, double ramp) {
  if (ramp <= 0) return 1;
  return std::clamp(std::min(t, end - t) / ramp, 0.0, 1.0);
}

/// Counts missing answers; returns why driving must end, or an empty string.
class Watch {
 public:
  std::string take(const CoilDriver& driver, const ManualMoment& moment) {
    const DriveStatus status = moment.output.status;
    const std::string limited = limits_.take(moment.t, moment.output);
    misses_ = status == DriveStatus::no_answer ? misses_ + 1 : 0;
    if (misses_ >= max_missed_answers) return trouble_of(driver, status);
    if (status == DriveStatus::resumed) return "the coils had switched off by themselves";
    return trouble_of(status).empty() ? limited : trouble_of(driver, status);
  }

 private:
  DeviceLimits limits_;
  int misses_ = 0;
};

}  // namespace

ManualResult drive_by_hand(const Rig& rig, CoilDriver& driver, const ManualCommand& command,
                           const Eigen::VectorXd& temperatures,
                           const std::function<void(const ManualMoment&)>& heard,
                           const Stop& stop) {
  CoilDrive drive(rig.system.drives());
  drive.warm(temperatures);
  Wanted wanted(rig, command);
  Watch watch;
  ManualResult result;
  std::vector<double> channels(static_cast<std::size_t>(driver.capabilities().channels));
  const double period = 1 / rig.params.drive_rate;
  Standstill standstill(rig.params.safety.max_pause);
  const double began = steady_seconds();
  double before = -period;
  double end = command.seconds;
  ManualMoment moment;
  result.most = moment.output.acknowledged = 0 * drive.currents();
  while (moment.t < end && result.why.empty() && !stop()) {
    const double dt = moment.t - before;
    before = moment.t;
    CoilOutput& output = moment.output;
    wanted.advance(dt, output);
    const double share = share_at(moment.t, end, command.ramp);
    if (wanted.turns() && driver.capabilities().input == CoilInput::waveform) {
      output.scale = drive.turn(wanted.turning(share, output.reached), dt);
      output.status = send(driver, drive.turning());
      if (const auto phase = driver.report().phase) wanted.follow_phase(*phase);
    } else {
      output.scale = drive.step(share * output.currents, dt).scale;
      std::ranges::copy(drive.currents(), channels.begin());
      const Eigen::Vector3d field = wanted.actuation().field * drive.currents();
      output.status = driver.drive(constant_request(
          driver.capabilities(), std::span<const double, 3>(field.data(), 3), channels));
    }
    output.currents = drive.currents();
    output.temperatures = drive.temperatures();
    take_answer(driver, output);
    result.min_scale = std::min(result.min_scale, output.scale);
    result.min_device_scale = std::min(result.min_device_scale, output.device_scale);
    if (output.acknowledged.norm() > result.most.norm()) result.most = output.acknowledged;
    result.why = watch.take(driver, moment);
    try {
      if (heard) heard(moment);
    } catch (const std::exception& e) {
      if (result.why.empty()) result.why = e.what();
    }
    if (command.enough && command.enough())
      end = std::min(end, moment.t + std::min(command.ramp, moment.t));
    const double due = began + moment.t + period;
    if (const double left = due - steady_seconds(); left > 0)
      std::this_thread::sleep_for(std::chrono::duration<double>(left));
    moment.t = steady_seconds() - began;
    const std::string stood = standstill.pass(0);
    if (result.why.empty()) result.why = stood;
  }
  if (!result.why.empty())
    result.status = Status::fault;
  else if (moment.t < end)
    result.status = Status::stopped;
  result.zero = driver.stop();
  return result;
}

}  // namespace microswarm
