// SPDX-License-Identifier: Apache-2.0
// The checks of a camera and of a coil driver, which take real time.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "microswarm/rig/runtime/rig_checks.hpp"
#include "tests/rig/coil_rig.hpp"
#include "tests/rig/live_rigs.hpp"

namespace microswarm::rig {
namespace {

/// Pictures that differ, one every 5 ms or later, so many of them.
class ClockLike : public vision::FrameSource {
 public:
  explicit ClockLike(int count) : count_(count) {}
  bool next(vision::VideoFrame& frame) override {
    if (index_ >= count_) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    frame.index = index_++;
    frame.picture = {8, 6, 1, std::vector<std::uint8_t>(48, static_cast<std::uint8_t>(index_))};
    return true;
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return std::nullopt; }

 private:
  int count_;
  int index_ = 0;
};

class CameraChecks : public testing::Test {
 protected:
  /// Whether the check of that name is good, after a third of a second.
  bool good(const std::string& what, int frames, std::optional<double> rate = {}) {
    vision::NewestFrame camera(std::make_unique<ClockLike>(frames), "a clock");
    for (const RigCheck& check : check_camera(camera, rig, rate, 0.3, {}))
      if (check.what == what) return check.good;
    ADD_FAILURE() << "no check of the " << what;
    return false;
  }
  test::Folder folder;
  Rig rig = test::coil_rig(folder, "[{}, {}, {}]");
};

TEST_F(CameraChecks, AVideoMayEndACameraMayNot) {
  rig.params.camera = VideoCamera{};
  EXPECT_TRUE(good("camera", 10));
  EXPECT_TRUE(good("camera", 100'000));
  EXPECT_FALSE(good("camera", 1)) << "no time between frames";
  rig.params.camera = vision::CameraParams{};
  EXPECT_FALSE(good("camera", 10));
  EXPECT_TRUE(good("camera", 100'000));
}

// A camera that is asked for 30 Hz may set 5 Hz and keep to that.
TEST_F(CameraChecks, FramesComeAsOftenAsTheFileAsks) {
  rig.params.camera = vision::CameraParams{.rate = 10};
  EXPECT_TRUE(good("frames", 100'000));
  EXPECT_TRUE(good("frames", 100'000, 10));
  rig.params.camera = vision::CameraParams{.rate = 1000};
  EXPECT_FALSE(good("frames", 100'000, 10));
  EXPECT_FALSE(good("frames", 100'000));
}

TEST_F(CameraChecks, WhereTheFileAsksNothingTheCamerasRateCounts) {
  rig.params.camera = vision::GenicamParams{};
  EXPECT_TRUE(good("frames", 100'000, 10));
  EXPECT_FALSE(good("frames", 100'000, 1000));
}

TEST(DriverChecks, ZerosAreSentAsOftenAsCurrentsInARun) {
  const test::Folder folder;
  const auto log = std::make_shared<test::WatchedCoils::Log>();
  test::WatchedCoils driver(log);
  check_driver(driver, test::coil_rig(folder, "[{}, {}, {}]", {"drive_rate_hz=160"}), 0.3);
  EXPECT_GE(log->drives, 2);
  EXPECT_LE(log->drives, 49);
}

}  // namespace
}  // namespace microswarm::rig
