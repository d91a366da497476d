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

/// A scenario and the rig that it runs on, read and checked.
struct RigExperiment {
  Experiment experiment;
  Rig rig;

  const Scenario& scenario() const { return experiment.scenario(); }
};

/// Reads both files; settings are texts as from --set and --set-rig. Throws InputError with a line
/// for each thing wrong.
RigExperiment open_rig_experiment(const std::filesystem::path& scenario,
                                  const std::vector<std::string>& settings,
                                  const std::filesystem::path& rig,
                                  const std::vector<std::string>& rig_settings,
                                  std::optional<std::uint64_t> seed = std::nullopt);

/// What a rig's file names, opened.
struct Devices {
  std::unique_ptr<RealtimeRigSimulator> bench;  ///< of a simulated camera
  std::unique_ptr<CoilDriver> coils;
  std::unique_ptr<FrameSource> camera;
  CameraScale scale;

  CoilDriver& driver() { return bench ? bench->coils() : *coils; }
};

/// Opens camera and coils of a rig; with `dry`, nothing is sent to any coils. The experiment
/// outlives them. Throws HardwareError for a device that fails, InputError when the rig has no
/// scale.
Devices open_devices(const RigExperiment& on, bool dry);

/// The camera or video of a rig whose camera is no simulated one; errors as above.
std::unique_ptr<FrameSource> open_camera_of(const Rig& rig);

}  // namespace microswarm
