// SPDX-License-Identifier: Apache-2.0
// The program with cameras that are not there, see fake_camera.cpp and fake_genicam.cpp.
#pragma once

#include <algorithm>
#include <chrono>
#include <ostream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace microswarm::test {

/// A kind of camera and how the fake one of it differs from those of other kinds.
struct CameraKind {
  std::string name;
  std::string device;                ///< as commands take it
  std::string shim;                  ///< loaded before the program's libraries
  std::string yaml;                  ///< of a rig's camera, but for its size
  std::vector<std::string> formats;  ///< that it can show the scene in
  std::string grey;                  ///< one of them
  int gain = 0;                      ///< that it takes
};

inline std::ostream& operator<<(std::ostream& out, const CameraKind& kind) {
  return out << kind.name;
}

inline CameraKind v4l2_kind() {
  return {.name = "V4l2",
          .device = "/dev/video90",
          .shim = MICROSWARM_FAKE_CAMERA,
          .yaml = "type: v4l2, device: /dev/video90",
          .formats = {"YUYV", "GREY", "MJPG"},
          .grey = "GREY",
          .gain = 40};
}
#ifdef MICROSWARM_FAKE_GENICAM
inline CameraKind genicam_kind() {
  return {.name = "Genicam",
          .device = "genicam:Fake_1",
          .shim = MICROSWARM_FAKE_GENICAM,
          .yaml = "type: genicam, device: Fake_1, rate_hz: 50",
          .formats = {"Mono8", "RGB8", "Mono16", "BayerRG8"},
          .grey = "Mono8",
          .gain = 10};
}
#endif

class DeviceCamera : public CommandLine {
 protected:
  explicit DeviceCamera(CameraKind kind = v4l2_kind()) : kind_(std::move(kind)) {}

  /// The program sees a camera that is like this.
  void plug(const std::string& traits) {
    at.environment = {{"LD_PRELOAD", kind_.shim},
                      {"ASAN_OPTIONS", "verify_asan_link_order=0"},
                      {"FAKE_CAMERA", "device=/dev/video90 " + traits}};
  }
  Outcome see(const Arguments& more = {}) const {
    // A smooth disc, where swarms have grain.
    Arguments all{"rig",
                  "see",
                  kind_.device,
                  "--set",
                  "camera.width_px=320",
                  "--set",
                  "camera.height_px=240",
                  "--set",
                  "scene.swarm.look.min_texture=0"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  /// A fault of the hardware: one line that names the device, exit code 4, within ten seconds. A
  /// busy computer may take longer, by what it takes longer to start the program.
  void fails(const Arguments& more, const std::vector<std::string>& parts) const {
    const auto time_of = [](auto&& what) {
      const auto began = std::chrono::steady_clock::now();
      what();
      return std::chrono::steady_clock::now() - began;
    };
    constexpr int starts = 50;  // of the program count as much as what it does beside waiting
    Outcome outcome;
    const auto before = time_of([&] { run({"--version"}); });
    const auto took = time_of([&] { outcome = see(more); });
    const auto after = time_of([&] { run({"--version"}); });
    EXPECT_LT(took, std::chrono::seconds(8) + starts * std::max(before, after));
    EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(is_one_line_naming(outcome.err, "microswarm: " + kind_.device, parts))
        << outcome.err;
  }
  /// A rig with this camera and simulated coils, and a scenario for it.
  void write_flight() const {
    write("coils.yaml", "coils: {type: helmholtz}\n");
    write("rig.yaml",
          "coils: coils.yaml\n"
          "field: {kind: rotating, amplitude_mt: 8, frequency_hz: 10, max_pitch_deg: 7.5}\n"
          "drive_rate_hz: 100\ndriver: {type: simulated}\n"
          "camera: {" +
              kind_.yaml +
              ", width_px: 320, height_px: 240}\n"
              "scale: {um_per_px: 6, origin_px: [-0.5, 239.5]}\n"
              "perception: {scene: {swarm: {look: {min_texture: 0}}}}\n"
              "safety: {min_follow_share: 0, frozen_swarm_s: 0, missed_deadlines: 100, "
              "max_pause_s: 3}\n");
    write("flight.yaml",
          "map: {type: polygons, lo_um: [0, 0], hi_um: [1920, 1440]}\n"
          "start: {x_um: 960, y_um: 720}\ngoal_um: [1500, 720]\ntime_limit_s: 20\n"
          "swarm: {type: vortex}\nnavigator: {type: radar}\n");
  }
  Outcome fly(const Arguments& more = {}) const {
    Arguments all{"rig", "run", "flight.yaml", "--rig", "rig.yaml"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }

  CameraKind kind_;
};

}  // namespace microswarm::test
