// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/runtime/realtime_rig_simulator.hpp"

namespace microswarm {

/// A scenario and its rig, read and validated.
struct RigExperiment {
  Experiment experiment;
  Rig rig;

  const Scenario& scenario() const { return experiment.scenario(); }
};

/// Reads both files; settings are texts as from --set and --set-rig. Throws InputError with one
/// line per issue.
RigExperiment open_rig_experiment(const std::filesystem::path& scenario,
                                  const std::vector<std::string>& settings,
                                  const std::filesystem::path& rig,
                                  const std::vector<std::string>& rig_settings,
                                  std::optional<std::uint64_t> seed = std::nullopt);

/// Open devices of a rig.
struct Devices {
  std::unique_ptr<RealtimeRigSimulator> bench;  ///< set for a simulated camera
  std::unique_ptr<CoilDriver> coils;
  std::unique_ptr<FrameSource> camera;
  CameraScale scale;

  CoilDriver& driver() { return bench ? bench->coils() : *coils; }
};

/// Opens camera and coils of a rig. With `dry`, nothing is sent to the coils. The experiment must
/// outlive the devices. Throws HardwareError if a device fails, InputError if the rig has no scale.
Devices open_devices(const RigExperiment& on, bool dry);

/// Opens the camera or video of a rig whose camera is not simulated; errors as above.
std::unique_ptr<FrameSource> open_camera_of(const Rig& rig);

}  // namespace microswarm
