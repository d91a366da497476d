// SPDX-License-Identifier: Apache-2.0
// Cameras and how they fail, through the program. What holds for both kinds is EachCamera.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/vision/camera/frames.hpp"
#include "tests/cli/device_camera.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

/// Both kinds of cameras.
class EachCamera : public DeviceCamera, public testing::WithParamInterface<CameraKind> {
 protected:
  EachCamera() : DeviceCamera(GetParam()) {}
};

std::vector<CameraKind> kinds() {
#ifdef MICROSWARM_FAKE_GENICAM
  return {v4l2_kind(), genicam_kind()};
#else
  return {v4l2_kind()};
#endif
}
constexpr auto name_of_kind = [](const testing::TestParamInfo<CameraKind>& info) {
  return info.param.name;
};
INSTANTIATE_TEST_SUITE_P(Of, EachCamera, testing::ValuesIn(kinds()), name_of_kind);

TEST_P(EachCamera, ShowsTheSwarmInEveryFormat) {
  for (const std::string& format : kind_.formats) {
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

TEST_P(EachCamera, SettingsReachTheCamera) {
  plug("");
  // The fake camera's background is brighter by its gain. What is automatic must be let go.
  const Outcome outcome =
      see({"--json", "--set", "camera.pixel_format=" + kind_.grey, "--set",
           "camera.gain=" + std::to_string(kind_.gain), "--set", "camera.exposure_ms=20"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NEAR(Json::parse(outcome.out)["candidates"][0]["contrast"].get<double>(), 60 + kind_.gain,
              3);
}

TEST_F(DeviceCamera, WhatItDoesNotTakeIsRefused) {
  plug("");
  fails({"--set", "camera.focus=10"}, {"focus"});
  fails({"--set", "camera.exposure_ms=500"}, {"exposure_ms", "500", "0.3..204.7"});
  fails({"--set", "camera.gain=101"}, {"gain", "101", "0..100"});
  fails({"--set", "camera.region.x_px=8"}, {"region"});
  EXPECT_EQ(see({"--set", "camera.white_balance=5000"}).code, 0);
  plug("controls=0");
  fails({"--set", "camera.white_balance=4000"}, {"white_balance"});
  plug("region=1");
  fails({"--set", "camera.region.x_px=12"}, {"640x480 at 8,0", "640x480 at 12,0"});
  EXPECT_EQ(see({"--set", "camera.region.x_px=16"}).code, 0);
}

TEST_P(EachCamera, SettingsThatItDoesNotHaveAreRefused) {
  plug("controls=0");
  for (const std::string key : {"exposure_ms=20", "gain=3"})
    fails({"--set", "camera." + key}, {key.substr(0, key.find('='))});
}

TEST_F(DeviceCamera, WhatIsNoCameraOrBusyIsRefused) {
  plug("busy=1");
  fails({}, {"in use by another program"});
  plug("no_camera=1");
  fails({}, {"no camera"});
  plug("output=1");
  fails({}, {"no camera"});
}

TEST_P(EachCamera, UnpluggedStalledOrDamagedItFails) {
  plug("unplug=5");
  fails({}, {"unplugged"});
  plug("stall=5");
  fails({}, {"no picture for 1 s"});
  plug("stall=0");
  fails({}, {"no picture for 1 s"});
  plug("damaged=5");
  fails({}, {"damaged"});
  plug("hang=3");
  fails({}, {"no picture for 1 s"});
}

TEST_F(DeviceCamera, ASlowOneIsNotSilent) {
  plug("rate=1");
  EXPECT_EQ(see().code, 0);
}

TEST_F(DeviceCamera, WhatIsDamagedIsTold) {
  plug("damaged=5");
  fails({}, {"damaged", "76800 of 153600 bytes"});
  plug("damaged=5 formats=MJPG");
  fails({}, {"damaged", "JPEG"});
}

TEST_P(EachCamera, ADamagedFrameNowAndThenIsLeftOut) {
  for (const std::string& format : kind_.formats) {
    plug("every=3");
    EXPECT_EQ(see({"--set", "camera.pixel_format=" + format}).code, 0) << format;
  }
}

TEST_P(EachCamera, AStillIsStoredAsItCame) {
  plug("");
  const std::string said =
      good({"rig", "still", kind_.device, "--set", "width_px=320", "--set", "height_px=240",
            "--set", "pixel_format=" + kind_.grey, "--out", "still.png"});
  EXPECT_TRUE(names(said, "still.png: 320 × 240 px, grey")) << said;
  EXPECT_EQ(run({"rig", "see", "still.png", "--set", "scene.swarm.look.min_texture=0"}).code, 0);
  write("rig.yaml", "coils: coils.yaml\ndriver: {type: simulated}\ncamera: {" + kind_.yaml +
                        ", width_px: 200, height_px: 100}\n");
  write("coils.yaml", "coils: {type: helmholtz}\n");
  const std::string small =
      good({"rig", "still", kind_.device, "--rig", "rig.yaml", "--out", "small.png"});
  EXPECT_TRUE(names(small, "200 × 100")) << small;
  refused({"rig", "still", "still.png"}, naming("still.png", {"camera"}));
  plug("unplug=3");
  const Outcome outcome = run({"rig", "still", kind_.device, "--out", "none.png"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_FALSE(exists("none.png"));
}

TEST_P(EachCamera, ItsScaleIsTakenFromAStill) {
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
      Json::parse(good({"rig", "scale", kind_.device, "--grid", "9x6", "--pitch", "100", "--set",
                        "width_px=320", "--set", "height_px=240", "--json"}));
  EXPECT_NEAR(told["scale"]["um_per_px"].get<double>(), 100 / 30.0, 1e-3);
  EXPECT_EQ(told["points"], 54);
}

TEST_P(EachCamera, AMapIsSegmentedFromAStill) {
  std::string photo = "P5\n640 480\n255\n";
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x)
      photo += static_cast<char>(std::abs(y - 240) < 12 || std::abs(x - 320) < 9 ? 70 : 180);
  write("photo.pgm", photo);
  plug("scene=photo.pgm formats=GREY");
  write("coils.yaml", "coils: {type: helmholtz}\n");
  write("rig.yaml", "coils: coils.yaml\ndriver: {type: simulated}\ncamera: {" + kind_.yaml +
                        ", width_px: 640, height_px: 480}\n");
  const Arguments segment{"--um-per-px", "5",        "--out", "vessels.geojson",
                          "--rig",       "rig.yaml", "--json"};
  const auto share_of = [&](const std::string& source) {
    Arguments all{"map", "segment", source};
    all.insert(all.end(), segment.begin(), segment.end());
    return Json::parse(good(all))["vessel_share"].get<double>();
  };
  EXPECT_NEAR(share_of(kind_.device), share_of("photo.pgm"), 0.005);
}

/// A run with a camera that fails in it; the coils are simulated.
class EachCameraRun : public EachCamera {
 protected:
  EachCameraRun() { write_flight(); }
  void ends_it(const std::string& traits, const std::string& reason) {
    plug(traits);
    const Outcome outcome = fly({"--seconds", "15"});
    EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
    EXPECT_TRUE(names(outcome.out + outcome.err, reason)) << outcome.out << outcome.err;
  }
};

INSTANTIATE_TEST_SUITE_P(Of, EachCameraRun, testing::ValuesIn(kinds()), name_of_kind);

TEST_P(EachCameraRun, GoesOnUntilItsTimeIsUp) {
  plug("every=5");
  const Outcome outcome = fly({"--seconds", "2"});
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
}

TEST_P(EachCameraRun, ACameraThatFailsEndsIt) {
  ends_it("unplug=60", kind_.device + ": was unplugged");
  ends_it("damaged=60", kind_.device + ": gives damaged pictures");
  ends_it("stall=60", "s old, allowed 0.5 s");
  ends_it("hang=60", "s old, allowed 0.5 s");
}

TEST_P(EachCameraRun, ItsWatchIsThatOfTheRig) {
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

TEST_P(EachCameraRun, ItsVideoHasTheRecordsClock) {
  plug("formats=GREY");
  const Outcome outcome =
      fly({"--seconds", "2", "--out", "out", "--video", "out/camera.mkv", "--json"});
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
  std::istringstream rows(read("out/camera.csv"));
  std::string line;
  std::getline(rows, line);
  std::vector<double> times;
  while (std::getline(rows, line)) times.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  const auto video = vision::open_frames(at.folder / "out/camera.mkv");
  vision::VideoFrame frame;
  std::size_t count = 0;
  while (video->next(frame)) ++count;
  EXPECT_EQ(count, times.size());
  EXPECT_GT(count, 80U);  // at 50 a second
  EXPECT_TRUE(names(outcome.out, "\"frames\": " + std::to_string(count))) << outcome.out;
  EXPECT_FALSE(exists("out/camera.part.mkv") || exists("out/camera.part.csv"));
  // Every frame that the navigator saw is in the video, with its time.
  const experiment::Record record = experiment::read_record(at.folder / "out/run.h5");
  EXPECT_GT(record.frames.size(), 10U);
  for (const experiment::Frame& tick : record.frames) {
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

TEST_P(EachCameraRun, AVideoThatFindsNoRoomIsToldAndTheRunGoesOn) {
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

TEST_F(DeviceCamera, WhatItDoesNotTakeIsRefusedBeforeARun) {
  write_flight();
  plug("width=640 height=480");
  const Outcome outcome = fly();
  EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
  EXPECT_TRUE(is_one_line_naming(outcome.err, "microswarm: /dev/video90", {"640x480", "320x240"}))
      << outcome.err;
}

TEST_F(DeviceCamera, IsListedWithItsFormats) {
  plug("formats=YUYV,H264");
  const Json told = Json::parse(good({"rig", "cameras", "--json"}));
  const auto& list = told["cameras"];
  const auto found = std::ranges::find_if(
      list, [](const Json& camera) { return camera["device"] == "/dev/video90"; });
  ASSERT_NE(found, list.end()) << told;
  ASSERT_EQ((*found)["formats"].size(), 2U);
  EXPECT_EQ((*found)["formats"][0]["name"], "YUYV");
  EXPECT_EQ((*found)["formats"][0]["readable"], true);
  EXPECT_EQ((*found)["formats"][0]["sizes"], "320x240, 640x480");
  EXPECT_EQ((*found)["formats"][1]["readable"], false);
  EXPECT_EQ((*found)["model"], "a ?fake camera");
  EXPECT_TRUE(names(good({"rig", "cameras"}), "/dev/video90"));
}

}  // namespace
}  // namespace microswarm::test
