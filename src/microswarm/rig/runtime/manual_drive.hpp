// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::rig {

/// Manual command of the coils, with the target position at the centre.
struct ManualCommand {
  actuation::Setpoint wanted{};
  double seconds = 5;              ///< duration, both ramps included [s]
  double ramp = 0.5;               ///< duration of the ramp at the start and at the end [s]
  std::function<bool()> enough{};  ///< asked after each output; true starts the final ramp
};

/// One output of a manual drive.
struct ManualMoment {
  double t = 0;  ///< time since the first [s]
  actuation::CoilOutput output{};
};

/// Result of a manual drive: `solved` after its time, `stopped`, or `fault`.
struct ManualResult {
  Status status = Status::solved;
  std::string why{};             ///< reason of a fault
  actuation::StopReport zero{};  ///< of the zero at the end
  double min_scale = 1;          ///< minimum scale by the coils' limits
  double min_device_scale = 1;   ///< minimum scale by the device's own limits
  Eigen::VectorXd most{};        ///< largest currents that the device acknowledged [A]
};

/// Drives the coils manually at the rig's drive rate, within the limits of the coil system, and
/// sets them to zero at the end, on a fault and when it is stopped. Faults are: a driver that does
/// not answer, reports trouble, switched off by itself or leaves almost no current by its own
/// limits, and a standstill of the program. `temperatures`: coils at the start [°C]. `listener` is
/// called after each output; an exception from it is a fault.
ManualResult drive_by_hand(const Rig& rig, actuation::CoilDriver& driver,
                           const ManualCommand& command, const Eigen::VectorXd& temperatures,
                           const std::function<void(const ManualMoment&)>& listener = {},
                           const Stop& stop = {});

}  // namespace microswarm::rig
