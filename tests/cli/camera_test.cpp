// SPDX-License-Identifier: Apache-2.0
// Cameras of V4L2 and how they fail, through the program and fake_camera.cpp.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/vision/camera/frames.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

class DeviceCamera : public CommandLine {
 protected:
  /// The program sees a camera at /dev/video90 that is like this.
  void plug(const std::string& traits) {
    at.environment = {{"LD_PRELOAD", MICROSWARM_FAKE_CAMERA},
                      {"ASAN_OPTIONS", "verify_asan_link_order=0"},
                      {"FAKE_CAMERA", "device=/dev/video90 " + traits}};
  }
  Outcome see(const Arguments& more = {}) const {
    // A smooth disc, where swarms have grain.
    Arguments all{"rig",
                  "see",
                  "/dev/video90",
                  "--set",
                  "camera.width_px=320",
                  "--set",
                  "camera.height_px=240",
                  "--set",
                  "scene.swarm.look.min_texture=0"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  /// A fault of the hardware: one line that names the device, exit code 4, within ten seconds.
  void fails(const Arguments& more, const std::vector<std::string>& parts) const {
    const auto began = std::chrono::steady_clock::now();
    const Outcome outcome = see(more);
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));
    EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(is_one_line_naming(outcome.err, "microswarm: /dev/video90", parts)) << outcome.err;
  }
};

TEST_F(DeviceCamera, ShowsTheSwarmInEveryFormat) {
  for (const std::string format : {"YUYV", "GREY", "MJPG"}) {
    plug("");
    const Outcome outcome = see({"--json", "--set", "camera.pixel_format=" + format});
    ASSERT_EQ(outcome.code, 0) << format << outcome.err;
    const Json told = Json::parse(outcome.out);
    EXPECT_NEAR(told["candidates"][0]["centre_px"][0].get<double>(), 160, 0.2) << format;
    EXPECT_NEAR(told["candidates"][0]["centre_px"][1].get<double>(), 120, 0.2) << format;
    EXPECT_NEAR(told["candidates"][0]["radius_px"].get<double>(), 25, 0.7) << format;
    EXPECT_NEAR(told["candidates"][0]["contrast"].get<double>(), 60, 3) << format;
  }
}

TEST_F(DeviceCamera, AnotherSizeOrFormatIsRefused) {
  plug("width=640 height=480");
  fails({}, {"640x480", "320x240"});
  plug("formats=YUYV,GREY");
  fails({"--set", "camera.pixel_format=MJPG"}, {"MJPG", "YUYV, GREY"});
  plug("formats=H264,MJPG");
  fails({}, {"H264", "pixel_format", "H264, MJPG"});
}

TEST_F(DeviceCamera, SettingsReachTheCamera) {
  plug("");
  const auto contrast = [&](const Arguments& more) {
    Arguments all{"--json", "--set", "camera.pixel_format=GREY"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = see(all);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out)["candidates"][0]["contrast"].get<double>();
  };
  // The fake camera's background is brighter by its gain. The others must be let go by automatics.
  EXPECT_NEAR(contrast({"--set", "camera.gain=40", "--set", "camera.exposure_ms=20", "--set",
                        "camera.white_balance=5000"}),
              100, 3);
}

TEST_F(DeviceCamera, WhatItDoesNotTakeIsRefused) {
  plug("");
  fails({"--set", "camera.focus=10"}, {"focus"});
  fails({"--set", "camera.exposure_ms=500"}, {"exposure_ms", "500", "0.3..204.7"});
  fails({"--set", "camera.gain=101"}, {"gain", "101", "0..100"});
  fails({"--set", "camera.region.x_px=8"}, {"region"});
  plug("controls=0");
  for (const std::string key : {"exposure_ms=20", "gain=3", "white_balance=4000"})
    fails({"--set", "camera." + key}, {key.substr(0, key.find('='))});
  plug("region=1");
  fails({"--set", "camera.region.x_px=12"}, {"640x480 at 8,0", "640x480 at 12,0"});
  EXPECT_EQ(see({"--set", "camera.region.x_px=16"}).code, 0);
}

TEST_F(DeviceCamera, WhatIsNoCameraOrBusyIsRefused) {
  plug("busy=1");
  fails({}, {"in use by another program"});
  plug("no_camera=1");
  fails({}, {"no camera"});
  plug("output=1");
  fails({}, {"no camera"});
}

TEST_F(DeviceCamera, UnpluggedStalledOrDamagedItFails) {
  plug("unplug=5");
  fails({}, {"unplugged"});
  plug("stall=5");
  fails({}, {"no picture for 1 s"});
  plug("stall=0");
  fails({}, {"no picture for 1 s"});
  plug("damaged=5");
  fails({}, {"damaged", "76800 of 153600 bytes"});
  plug("damaged=5 formats=MJPG");
  fails({}, {"damaged", "JPEG"});
  plug("hang=3");
  fails({}, {"no picture for 1 s"});
}

TEST_F(DeviceCamera, ADamagedFrameNowAndThenIsLeftOut) {
  for (const std::string format : {"YUYV", "GREY", "MJPG"}) {
    plug("every=3 formats=" + format);
    EXPECT_EQ(see().code, 0) << format;
  }
}

TEST_F(DeviceCamera, AStillIsStoredAsItCame) {
  plug("formats=GREY");
  const std::string said = good({"rig", "still", "/dev/video90", "--set", "width_px=320", "--set",
                                 "height_px=240", "--out", "still.png"});
  EXPECT_TRUE(names(said, "still.png: 320 × 240 px, grey")) << said;
  EXPECT_EQ(run({"rig", "see", "still.png", "--set", "scene.swarm.look.min_texture=0"}).code, 0);
  write("rig.yaml",
        "coils: coils.yaml\ndriver: {type: simulated}\n"
        "camera: {type: v4l2, width_px: 200, height_px: 100}\n");
  write("coils.yaml", "coils: {type: helmholtz}\n");
  const std::string small =
      good({"rig", "still", "/dev/video90", "--rig", "rig.yaml", "--out", "small.png"});
  EXPECT_TRUE(names(small, "200 × 100")) << small;
  refused({"rig", "still", "still.png"}, naming("still.png", {"camera"}));
  plug("unplug=3");
  const Outcome outcome = run({"rig", "still", "/dev/video90", "--out", "none.png"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_FALSE(exists("none.png"));
}

TEST_F(DeviceCamera, ItsScaleIsTakenFromAStill) {
  std::string slide = "P5\n320 240\n255\n";
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const int dx = (x + 15) % 30 - 15, dy = (y + 15) % 30 - 15;
      const bool dot = x > 15 && x < 285 && y > 15 && y < 195 && dx * dx + dy * dy < 36;
      slide += static_cast<char>(dot ? 60 : 120);
    }
  write("slide.pgm", slide);
  plug("scene=slide.pgm formats=GREY");
  const Json told =
      Json::parse(good({"rig", "scale", "/dev/video90", "--grid", "9x6", "--pitch", "100", "--set",
                        "width_px=320", "--set", "height_px=240", "--json"}));
  EXPECT_NEAR(told["scale"]["um_per_px"].get<double>(), 100 / 30.0, 1e-3);
  EXPECT_EQ(told["points"], 54);
}

TEST_F(DeviceCamera, AMapIsSegmentedFromAStill) {
  std::string photo = "P5\n640 480\n255\n";
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x)
      photo += static_cast<char>(std::abs(y - 240) < 12 || std::abs(x - 320) < 9 ? 70 : 180);
  write("photo.pgm", photo);
  plug("scene=photo.pgm formats=GREY");
  const Arguments segment{"--um-per-px", "5", "--out", "vessels.geojson", "--json"};
  const auto share_of = [&](const std::string& source) {
    Arguments all{"map", "segment", source};
    all.insert(all.end(), segment.begin(), segment.end());
    return Json::parse(good(all))["vessel_share"].get<double>();
  };
  EXPECT_NEAR(share_of("/dev/video90"), share_of("photo.pgm"), 0.005);
}

/// A run with a camera that fails in it; the coils are simulated.
class DeviceCameraRun : public DeviceCamera {
 protected:
  DeviceCameraRun() {
    write("coils.yaml", "coils: {type: helmholtz}\n");
    write("rig.yaml",
          "coils: coils.yaml\n"
          "field: {kind: rotating, amplitude_mt: 8, frequency_hz: 10, max_pitch_deg: 7.5}\n"
          "drive_rate_hz: 100\ndriver: {type: simulated}\n"
          "camera: {type: v4l2, device: /dev/video90, width_px: 320, height_px: 240}\n"
          "scale: {um_per_px: 6, origin_px: [-0.5, 239.5]}\n"
          "perception: {scene: {swarm: {look: {min_texture: 0}}}}\n"
          "safety: {min_follow_share: 0, missed_deadlines: 100, max_pause_s: 3}\n");
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
  void ends_it(const std::string& traits, const std::string& reason) {
    plug(traits);
    const Outcome outcome = fly({"--seconds", "15"});
    EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
    EXPECT_TRUE(names(outcome.out + outcome.err, reason)) << outcome.out << outcome.err;
  }
};

TEST_F(DeviceCameraRun, GoesOnUntilItsTimeIsUp) {
  plug("every=5");
  const Outcome outcome = fly({"--seconds", "2"});
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
}

TEST_F(DeviceCameraRun, ACameraThatFailsEndsIt) {
  ends_it("unplug=60", "/dev/video90: was unplugged");
  ends_it("damaged=60", "/dev/video90: gives damaged pictures");
  ends_it("stall=60", "s old, allowed 0.5 s");
  ends_it("hang=60", "s old, allowed 0.5 s");
}

TEST_F(DeviceCameraRun, ItsWatchIsThatOfTheRig) {
  plug("");
  for (const char* command : {"run", "check"}) {
    const Arguments arguments =
        command == std::string("run")
            ? Arguments{"rig",
                        "run",
                        "flight.yaml",
                        "--rig",
                        "rig.yaml",
                        "--set-rig",
                        "camera.watch.black_below=200"}
            : Arguments{"rig", "check", "rig.yaml", "--set", "camera.watch.black_below=200"};
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
    EXPECT_TRUE(names(outcome.out + outcome.err, "black")) << outcome.out << outcome.err;
  }
}

TEST_F(DeviceCameraRun, ItsVideoHasTheRecordsClock) {
  plug("formats=GREY");
  const Outcome outcome =
      fly({"--seconds", "2", "--out", "out", "--video", "out/camera.mkv", "--json"});
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
  std::istringstream rows(read("out/camera.csv"));
  std::string line;
  std::getline(rows, line);
  std::vector<double> times;
  while (std::getline(rows, line)) times.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  const auto video = open_frames(at.folder / "out/camera.mkv");
  VideoFrame frame;
  std::size_t count = 0;
  while (video->next(frame)) ++count;
  EXPECT_EQ(count, times.size());
  EXPECT_GT(count, 80U);  // at 50 a second
  EXPECT_TRUE(names(outcome.out, "\"frames\": " + std::to_string(count))) << outcome.out;
  EXPECT_FALSE(exists("out/camera.part.mkv") || exists("out/camera.part.csv"));
  // Every frame that the navigator saw is in the video, with its time.
  const Record record = read_record(at.folder / "out/run.h5");
  EXPECT_GT(record.frames.size(), 10U);
  for (const Frame& tick : record.frames) {
    const double nearest =
        *std::ranges::min_element(times, {}, [&](double t) { return std::abs(t - tick.seen); });
    EXPECT_NEAR(nearest, tick.seen, 1e-6);
  }
  // It is not overwritten, and can be seen in place of the camera.
  const Outcome again = fly({"--seconds", "1", "--video", "out/camera.mkv"});
  EXPECT_EQ(again.code, 2);
  EXPECT_TRUE(names(again.err, "out/camera.mkv: ") && names(again.err, "--overwrite")) << again.err;
  EXPECT_EQ(fly({"--seconds", "1", "--set-rig", "camera.type=video", "--set-rig",
                 "camera.file=out/camera.mkv"})
                .code,
            3);
}

TEST_F(DeviceCameraRun, AVideoThatFindsNoRoomIsToldAndTheRunGoesOn) {
  plug("formats=GREY");
  at.largest_file = 300'000;
  const Outcome outcome = fly({"--seconds", "2", "--video", "camera.mkv"});
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
  EXPECT_TRUE(names(outcome.err, "camera.mkv: write failed")) << outcome.err;
  EXPECT_FALSE(exists("camera.mkv"));
  const Outcome nowhere = fly({"--video", "none/camera.mkv"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_TRUE(is_one_line_naming(nowhere.err, "microswarm: none/camera.mkv", {"cannot write"}))
      << nowhere.err;
}

TEST_F(DeviceCameraRun, WhatTheCameraDoesNotTakeIsRefusedBeforeIt) {
  plug("width=640 height=480");
  const Outcome outcome = fly();
  EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
  EXPECT_TRUE(is_one_line_naming(outcome.err, "microswarm: /dev/video90", {"640x480", "320x240"}))
      << outcome.err;
}

}  // namespace
}  // namespace microswarm::test
