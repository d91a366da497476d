// SPDX-License-Identifier: Apache-2.0
// What only GenICam cameras do: through fake_genicam.cpp, and over the network with
// gige_camera.cpp.
#include <sys/wait.h>

#include <nlohmann/json.hpp>

#include "microswarm/formats/images/image.hpp"
#include "tests/cli/device_camera.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

class DeviceCameraGenicam : public DeviceCamera {
 protected:
  DeviceCameraGenicam() : DeviceCamera(genicam_kind()) {}
};

TEST_F(DeviceCameraGenicam, WhatItDoesNotTakeIsRefused) {
  plug("");
  fails({"--set", "camera.width_px=3000"}, {"width_px", "3000", "1..2048"});
  fails({"--set", "camera.pixel_format=Mono12"}, {"Mono12", "Mono8, RGB8, Mono16"});
  fails({"--set", "camera.rate_hz=5000"}, {"rate_hz", "5000", "0.1..1000"});
  fails({"--set", "camera.exposure_ms=0.001"}, {"exposure_ms", "0.001", "0.01..10000"});
  fails({"--set", "camera.gain=11"}, {"gain", "11", "0..10"});
  fails({"--set", "camera.packet_size=1500"}, {"packet_size", "GigE"});
  plug("step=16");
  fails({"--set", "camera.width_px=340"}, {"width_px", "340", "1..2048 in steps of 16"});
}

TEST_F(DeviceCameraGenicam, WhatIsNotGivenStaysAsItIs) {
  plug("");
  EXPECT_TRUE(names(good({"rig", "still", kind_.device, "--out", "a.png"}), "512 × 512 px, grey"));
  EXPECT_TRUE(names(good({"rig", "still", kind_.device, "--set", "width_px=320", "--out", "b.png"}),
                    "320 × 512"));
}

TEST_F(DeviceCameraGenicam, InUseOrAbsentIsRefused) {
  plug("busy=1");
  fails({}, {"Failed to claim"});
  plug("");
  const Outcome outcome = run({"rig", "still", "genicam:none"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(is_one_line_naming(outcome.err, "microswarm: genicam:none", {"not found"}))
      << outcome.err;
}

TEST_F(DeviceCameraGenicam, PicturesThatChangeTheirSizeAreDamaged) {
  plug("grow=10");
  fails({}, {"damaged", "larger"});
}

TEST_F(DeviceCameraGenicam, ADrawnOneIsNotFoundWithoutItsName) {
  EXPECT_FALSE(names(good({"rig", "cameras", "--json"}), "Fake_1"));
  // Another test's camera may be found.
  const Outcome first = run({"rig", "still", "genicam:", "--out", "still.png"});
  EXPECT_FALSE(names(first.out + first.err, "Fake_1")) << first.out << first.err;
}

/// A camera of GigE Vision on the loopback, as a program of its own.
class GigeCameraProgram {
 public:
  GigeCameraProgram() {
    int in[2];
    int out[2];
    if (::pipe2(in, O_CLOEXEC) != 0 || ::pipe2(out, O_CLOEXEC) != 0) return;
    child_ = ::fork();
    if (child_ == 0) {
      ::dup2(in[0], STDIN_FILENO);
      ::dup2(out[1], STDOUT_FILENO);
      ::execl(MICROSWARM_GIGE_CAMERA, MICROSWARM_GIGE_CAMERA, nullptr);
      ::_exit(127);
    }
    ::close(in[0]);
    ::close(out[1]);
    input_ = in[1];
    char said[6] = {};
    ready_ = ::read(out[0], said, 5) == 5 && std::string(said) == "ready";
    ::close(out[0]);
  }
  ~GigeCameraProgram() { unplug(); }
  GigeCameraProgram(const GigeCameraProgram&) = delete;
  GigeCameraProgram& operator=(const GigeCameraProgram&) = delete;

  bool is_ready() const { return ready_; }
  void unplug() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(std::exchange(child_, 0), nullptr, 0);
    ::close(input_);
  }

 private:
  pid_t child_ = 0;
  int input_ = -1;
  bool ready_ = false;
};

class GigeCamera : public DeviceCameraGenicam {
 protected:
  GigeCamera() {
    kind_.device = "genicam:127.0.0.1";
    kind_.yaml = "type: genicam, device: 127.0.0.1, rate_hz: 50";
  }
};

TEST_F(GigeCamera, IsSeenListedHeldAndUnplugged) {
  EXPECT_TRUE(names(run({"rig", "still", "genicam:", "--out", "still.png"}).err,
                    "no GenICam camera was found"));
  GigeCameraProgram camera;
  if (!camera.is_ready()) GTEST_SKIP() << "the port of GigE Vision is taken";
  EXPECT_TRUE(names(good({"rig", "still", kind_.device, "--set", "pixel_format=RGB8", "--set",
                          "packet_size=1400", "--out", "still.png"}),
                    "512 × 512 px, in colours"));
  EXPECT_TRUE(names(good({"rig", "cameras"}), "genicam:Aravis-Fake-test"));
  write_flight();
  // Its pattern is no swarm; of interest is the camera. A loaded computer is no fault here.
  Arguments flight{"rig", "run", "flight.yaml", "--rig", "rig.yaml", "--seconds", "30"};
  for (const char* setting :
       {"camera.pixel_format=Mono8", "camera.watch.silent_after_s=3", "safety.max_frame_age_s=2",
        "safety.lost_swarm_s=100", "safety.missed_deadlines=100000", "safety.deadman_s=20",
        "safety.max_pause_s=20"})
    flight.insert(flight.end(), {"--set-rig", setting});
  Program runs(flight, at);
  runs.let_work(1500);
  const Outcome other = run({"rig", "still", kind_.device});
  EXPECT_EQ(other.code, 4);
  EXPECT_TRUE(is_one_line_naming(other.err, "microswarm: " + kind_.device, {"in use"}))
      << other.err;
  if (!runs.running()) {
    const Outcome early = runs.wait();
    FAIL() << early.out << early.err;
  }
  camera.unplug();
  const auto began = std::chrono::steady_clock::now();
  const Outcome outcome = runs.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(8));
  EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
  EXPECT_TRUE(names(outcome.out + outcome.err, "s old, allowed 2 s") ||
              names(outcome.out + outcome.err, "unplugged"))
      << outcome.out << outcome.err;
}

}  // namespace
}  // namespace microswarm::test
