// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "microswarm/rig/params/rig_experiment.hpp"
#include "microswarm/rig/runtime/realtime_rig_simulator.hpp"

namespace microswarm::rig {

/// Open devices of a rig.
struct Devices {
  std::unique_ptr<RealtimeRigSimulator> simulator{};  ///< set for a simulated camera
  std::unique_ptr<actuation::CoilDriver> coils{};
  std::unique_ptr<vision::FrameSource> camera{};
  std::optional<double> camera_rate{};  ///< [Hz]; empty if unknown
  vision::CameraScale scale{};

  actuation::CoilDriver& driver() { return simulator ? simulator->coils() : *coils; }
};

/// Opens camera and coils of a rig. With `dry`, nothing is sent to the coils; with `idle`, a
/// simulated swarm ignores the field. The experiment must outlive the devices. Throws HardwareError
/// if a device fails, InputError if the rig has no scale.
Devices open_devices(const RigExperiment& on, bool dry, bool idle = false);

/// Opens the coil driver of a rig. Throws HardwareError if the device fails.
std::unique_ptr<actuation::CoilDriver> open_coils(const Rig& rig);

/// Opens the camera or video of a rig; nothing if its camera is simulated. Errors as above.
std::unique_ptr<vision::FrameSource> open_rig_camera(const Rig& rig);

}  // namespace microswarm::rig
