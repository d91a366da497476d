// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/manual_drive.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/rig/runtime/device_limits.hpp"
#include "microswarm/rig/runtime/first_reason.hpp"
#include "microswarm/rig/runtime/rig_priority.hpp"
#include "microswarm/rig/runtime/standstill.hpp"

namespace microswarm::rig {
namespace {

/// Share at `t` of a command that ends at `end`, with linear ramps of `ramp` [s].
double share_at(double t, double end, double ramp) {
  if (ramp <= 0) return 1;
  return std::clamp(std::min(t, end - t) / ramp, 0.0, 1.0);
}

/// Heading at the start.
double heading_along(const actuation::Setpoint& setpoint) {
  const auto* const command = std::get_if<Command>(&setpoint);
  return command ? command->heading : 0;
}

/// Reports an output to `listener`. Returns the message of an exception, or an empty string.
std::string tell(const std::function<void(const ManualMoment&)>& listener,
                 const ManualMoment& moment) {
  try {
    if (listener) listener(moment);
    return {};
  } catch (const std::exception& e) {
    return e.what();
  }
}

void take(const actuation::CoilOutput& output, ManualResult& result) {
  result.min_scale = std::min(result.min_scale, output.scale);
  result.min_device_scale = std::min(result.min_device_scale, output.device_scale);
  if (output.acknowledged.norm() > result.most.norm()) result.most = output.acknowledged;
}

}  // namespace

ManualResult drive_by_hand(const Rig& rig, actuation::CoilDriver& driver,
                           const ManualCommand& command, const Eigen::VectorXd& temperatures,
                           const std::function<void(const ManualMoment&)>& listener,
                           const Stop& stop) {
  const RigPriority priority(rig);
  actuation::CoilController controller(rig.system, rig.params.field, driver,
                                       heading_along(command.wanted));
  controller.warm(temperatures);
  controller.command(command.wanted);
  ManualResult result{.most = controller.output().acknowledged};
  DeviceLimits limits;
  Standstill standstill(rig.params.safety.max_pause);
  const double period = 1 / rig.params.drive_rate;
  const double began = steady_seconds();
  double before = -period;
  double end = command.seconds;
  ManualMoment moment;
  while (moment.t < end && result.why.empty() && !stop()) {
    const double dt = moment.t - std::exchange(before, moment.t);
    moment.output = controller.advance(dt, share_at(moment.t, end, command.ramp));
    take(moment.output, result);
    const bool resumed = moment.output.status == actuation::DriveStatus::resumed;
    result.why = first_reason({controller.trouble(),
                               resumed ? "the coils had switched off by themselves" : "",
                               limits.take(moment.t, moment.output), tell(listener, moment)});
    if (command.enough && command.enough())
      end = std::min(end, moment.t + std::min(command.ramp, moment.t));
    const double due = began + moment.t + period;
    if (const double left = due - steady_seconds(); left > 0)
      std::this_thread::sleep_for(std::chrono::duration<double>(left));
    moment.t = steady_seconds() - began;
    result.why = first_reason({result.why, standstill.pass(0)});
  }
  if (!result.why.empty())
    result.status = Status::fault;
  else if (moment.t < end)
    result.status = Status::stopped;
  result.zero = controller.stop();
  return result;
}

}  // namespace microswarm::rig
