// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <variant>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm {

/// What coils are driven with by hand: currents [A], a constant field at the centre [mT], or the
/// rig's own field for a command.
struct ManualCommand {
  std::variant<Eigen::VectorXd, Eigen::Vector3d, Command> wanted;
  double seconds = 5;              ///< with both ramps
  double ramp = 0.5;               ///< time in which it comes, and goes at the end [s]
  std::function<bool()> enough{};  ///< asked after each output: true: it goes now
};

/// One output.
struct ManualMoment {
  double t = 0;  ///< since the first [s]
  CoilOutput output;
};

/// How it ended: `solved` after its time, `stopped`, or `fault`.
struct ManualResult {
  Status status = Status::solved;
  std::string why;              ///< of a fault
  bool zero_confirmed = false;  ///< the device confirmed that the coils are at zero
  std::string stop_trouble;     ///< why another than the driver confirmed it, CoilDriver
  double min_scale = 1;         ///< scale of the command imposed by the coils' limits
  double min_device_scale = 1;  ///< by the device's own limits
  Eigen::VectorXd most;         ///< the largest currents that the device acknowledged [A]
};

/// Drives the coils by hand at the rig's drive rate, within the limits of the coil system, and sets
/// them to zero at the end, on a fault and when it is stopped. A driver that does not answer, is in
/// trouble, was off by itself, or whose limits leave next to nothing is a fault, and so is a
/// standstill of the program. `temperatures` are those of the coils at the start [°C]; `heard` is
/// called after each output; an exception from it is a fault.
ManualResult drive_by_hand(const Rig& rig, CoilDriver& driver, const ManualCommand& command,
                           const Eigen::VectorXd& temperatures,
                           const std::function<void(const ManualMoment&)>& heard = {},
                           const Stop& stop = {});

}  // namespace microswarm
