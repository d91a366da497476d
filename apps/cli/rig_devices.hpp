// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "microswarm/core/durations.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/runtime/live_bench.hpp"

namespace microswarm::cli {

/// A scenario and the rig that it runs on, read and checked.
struct RigScene {
  Scene scene;
  World world;
  Rig rig;
};

/// Says on stderr when the rig's kind of field is not the swarm's usual one.
void note_field(const Rig& rig, const Scenario& scenario);

/// Reads both files; settings are texts as from --set. Throws InputError in one line.
RigScene load_rig_scene(const std::filesystem::path& scenario,
                        const std::vector<std::string>& settings, const std::filesystem::path& rig,
                        const std::vector<std::string>& rig_settings);

/// What a rig's file names, opened.
struct Devices {
  std::unique_ptr<LiveBench> bench;  ///< of a simulated camera
  std::unique_ptr<CoilDriver> coils;
  std::unique_ptr<FrameSource> camera;
  CameraScale scale;

  CoilDriver& driver() { return bench ? bench->coils() : *coils; }
};

/// Opens camera and coils of a rig; with `dry`, nothing is sent to any coils. The scene outlives
/// them. Throws HardwareError for a device that fails, InputError when the rig has no scale.
Devices open_devices(const RigScene& on, bool dry);

/// The camera or video of a rig whose camera is no simulated one; errors as above.
std::unique_ptr<FrameSource> open_camera_of(const Rig& rig);

/// Times [s] for people: "1.2 / 3.4 / 5.6 ms", p50, p95 and p99.
std::string quantiles(const Durations& times);

}  // namespace microswarm::cli
