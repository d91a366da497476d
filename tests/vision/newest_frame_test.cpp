// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/newest_frame.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/vision/camera/camera.hpp"
#include "tests/files.hpp"

namespace microswarm::vision {
namespace {

using namespace std::chrono_literals;

/// A source that does what a test says with each picture; false ends it.
class Made : public FrameSource {
 public:
  using Make = std::function<bool(int index, formats::Image& picture)>;
  explicit Made(Make make) : make_(std::move(make)) {}
  bool next(VideoFrame& frame) override {
    frame.index = index_++;
    frame.picture = {8, 6, 1, std::vector<std::uint8_t>(48, 100)};
    return make_(frame.index, frame.picture);
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return std::nullopt; }

 private:
  Make make_;
  int index_ = 0;
};

std::unique_ptr<FrameSource> made(Made::Make make) {
  return std::make_unique<Made>(std::move(make));
}

/// Pictures that differ, one every `pause`.
std::unique_ptr<FrameSource> clock_like(std::chrono::microseconds pause) {
  return made([pause](int index, formats::Image& picture) {
    std::this_thread::sleep_for(pause);
    picture.pixels[0] = static_cast<std::uint8_t>(index);
    return true;
  });
}

/// Waits until the state is `wanted`, at most two seconds; how long that took [s].
double seconds_until(const NewestFrame& camera, CameraState wanted) {
  const double began = steady_seconds();
  while (camera.status().state != wanted && steady_seconds() < began + 2)
    std::this_thread::sleep_for(1ms);
  EXPECT_EQ(enum_name(camera.status().state), enum_name(wanted));
  return steady_seconds() - began;
}

std::string hardware_error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const HardwareError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(NewestFrame, OfAFastSourceTheNewestIsTakenAndTheOthersAreCounted) {
  NewestFrame camera(clock_like(500us), "fast");
  LiveFrame frame;
  int taken = 0;
  int last = -1;
  for (int k = 0; k < 10; ++k) {
    std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(camera.wait(frame, 1));
    ++taken;
    EXPECT_GT(frame.frame.index, last);
    last = frame.frame.index;
    EXPECT_EQ(frame.frame.picture.pixels[0], static_cast<std::uint8_t>(last));
    EXPECT_LE(frame.taken, steady_seconds());
  }
  const CameraStatus s = camera.status();
  EXPECT_EQ(s.state, CameraState::live);
  EXPECT_GT(s.dropped, 0);
  EXPECT_GE(s.frames, taken + s.dropped);      // all that came were taken, dropped,
  EXPECT_LE(s.frames, taken + s.dropped + 1);  // or are the one that waits
}

TEST(NewestFrame, AFrameThatIsLeftOutIsAGapAndAnUnevenPaceIsNone) {
  constexpr int lost = 24;
  NewestFrame camera(made([](int index, formats::Image& picture) {
                       std::this_thread::sleep_for(index == lost ? 200ms : index % 2 ? 20ms : 25ms);
                       picture.pixels[0] = static_cast<std::uint8_t>(index);
                       return index < 32;
                     }),
                     "uneven");
  const double began = steady_seconds();
  while (camera.status().state != CameraState::ended && steady_seconds() < began + 10)
    std::this_thread::sleep_for(5ms);
  EXPECT_GE(camera.status().gaps, 1);
  EXPECT_LT(camera.status().gaps, 8);  // on a busy computer some more
}

TEST(NewestFrame, OfASlowSourceEachFrameIsTakenOnceAndItsAgeIsTold) {
  NewestFrame camera(clock_like(60ms), "slow");
  LiveFrame frame;
  EXPECT_FALSE(camera.take(frame));
  EXPECT_EQ(camera.status().state, CameraState::opening);
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(camera.wait(frame, 1));
    EXPECT_EQ(frame.frame.index, k);
    EXPECT_FALSE(camera.take(frame));
    EXPECT_EQ(frame.frame.index, k);
    EXPECT_LT(steady_seconds() - frame.taken, 0.05);
  }
  std::this_thread::sleep_for(20ms);
  EXPECT_GE(camera.status().age, 0.02);
  EXPECT_EQ(camera.status().dropped, 0);
}

TEST(NewestFrame, TheSamePictureAgainAndAgainIsFrozenUntilAnotherComes) {
  std::atomic<bool> moves = false;
  NewestFrame camera(made([&](int index, formats::Image& picture) {
                       std::this_thread::sleep_for(1ms);
                       if (moves) picture.pixels[0] = static_cast<std::uint8_t>(index);
                       return true;
                     }),
                     "frozen", {.frozen_after = 4});
  seconds_until(camera, CameraState::frozen);
  EXPECT_GE(camera.status().frames, 4);
  LiveFrame frame;
  EXPECT_TRUE(camera.wait(frame, 1));  // it is told, and its frames are still there
  moves = true;
  seconds_until(camera, CameraState::live);
}

TEST(NewestFrame, PicturesWithoutLightAreBlack) {
  NewestFrame camera(made([](int index, formats::Image& picture) {
                       std::this_thread::sleep_for(1ms);
                       for (auto& g : picture.pixels) g = static_cast<std::uint8_t>(index % 7);
                       return true;
                     }),
                     "black");
  seconds_until(camera, CameraState::black);
}

TEST(NewestFrame, AnEndIsToldAndTheLastFrameIsKept) {
  NewestFrame camera(made([](int index, formats::Image&) { return index < 3; }), "ending");
  seconds_until(camera, CameraState::ended);
  LiveFrame frame;
  EXPECT_TRUE(camera.wait(frame, 5));
  EXPECT_EQ(frame.frame.index, 2);
  const double began = steady_seconds();
  EXPECT_FALSE(camera.wait(frame, 5));
  EXPECT_LT(steady_seconds() - began, 1);
  EXPECT_EQ(camera.status().dropped, 2);
}

TEST(NewestFrame, AFailureIsAHardwareErrorAtOnce) {
  NewestFrame camera(made([](int index, formats::Image&) -> bool {
                       if (index == 2) throw HardwareError("/dev/video7: gives no more pictures");
                       return true;
                     }),
                     "/dev/video7");
  EXPECT_LT(seconds_until(camera, CameraState::failed), 1);
  LiveFrame frame;
  EXPECT_TRUE(camera.take(frame));  // the last one before
  EXPECT_EQ(hardware_error_of([&] { camera.take(frame); }), "/dev/video7: gives no more pictures");
  EXPECT_EQ(hardware_error_of([&] { camera.wait(frame, 9); }),
            "/dev/video7: gives no more pictures");
  EXPECT_EQ(camera.status().why, "/dev/video7: gives no more pictures");
}

TEST(NewestFrame, ASilentSourceIsToldInTimeAndHoldsUpNobody) {
  std::atomic<bool> released = false;
  std::atomic<bool> gone = false;
  {
    NewestFrame camera(made([&](int index, formats::Image&) {
                         if (index == 0) return true;
                         while (!released) std::this_thread::sleep_for(1ms);
                         gone = true;
                         return false;
                       }),
                       "hung", {.silent_after = 0.1});
    LiveFrame frame;
    EXPECT_TRUE(camera.wait(frame, 1));
    EXPECT_LT(seconds_until(camera, CameraState::silent), 0.5);
    EXPECT_EQ(hardware_error_of([&] { camera.take(frame); }), "hung: no picture for 0.1 s");
    const double began = steady_seconds();
    EXPECT_EQ(hardware_error_of([&] { camera.wait(frame, 0.1); }), "hung: no picture for 0.1 s");
    EXPECT_LT(steady_seconds() - began, 0.5);
  }  // closed within a second, though its source hangs
  EXPECT_FALSE(gone);
  released = true;
  while (!gone) std::this_thread::sleep_for(1ms);
}

TEST(NewestFrame, IsOpenedAndClosedAgainAndAgain) {
  const double began = steady_seconds();
  for (int k = 0; k < 50; ++k) {
    NewestFrame camera(clock_like(100us), "again");
    LiveFrame frame;
    if (k % 2 == 0) {
      EXPECT_TRUE(camera.wait(frame, 1));
    }
  }
  EXPECT_LT(steady_seconds() - began, 5);
}

TEST(NewestFrame, ManyMayAsk) {
  NewestFrame camera(clock_like(200us), "many");
  std::atomic<int> taken = 0;
  std::vector<std::jthread> readers;
  readers.reserve(3);
  for (int r = 0; r < 3; ++r)
    readers.emplace_back([&] {
      LiveFrame frame;
      for (int k = 0; k < 20; ++k) {
        taken += camera.wait(frame, 1);
        EXPECT_GE(camera.status().frames, 1);
      }
    });
  readers.clear();
  EXPECT_GT(taken, 20);
  EXPECT_LE(taken, camera.status().frames);
}

TEST(NewestFrame, AListenerHearsEveryFrameAndItsTime) {
  std::vector<std::pair<int, double>> heard;  // of the camera's thread alone until it has ended
  NewestFrame camera(made([&](int index, formats::Image& picture) {
                       std::this_thread::sleep_for(2ms);
                       picture.pixels[0] = static_cast<std::uint8_t>(index);
                       return index < 50;
                     }),
                     "camera", {}, [&](const VideoFrame& frame, double taken) {
                       heard.emplace_back(frame.index, taken);
                     });
  std::vector<std::pair<int, double>> taken;
  LiveFrame frame;
  while (camera.status().state != CameraState::ended) {
    if (camera.wait(frame, 0.05)) taken.emplace_back(frame.frame.index, frame.taken);
    std::this_thread::sleep_for(5ms);
  }
  ASSERT_EQ(heard.size(), 50U);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(heard[static_cast<std::size_t>(i)].first, i);
  EXPECT_LT(taken.size(), 50U);
  for (const auto& one : taken) EXPECT_EQ(heard[static_cast<std::size_t>(one.first)], one);
}

TEST(Camera, NoSuchDeviceIsRefusedInOneLine) {
  const auto refusal = [](const std::string& device) {
    CameraParams params;
    params.device = device;
    return hardware_error_of([&] { open_camera(params); });
  };
  EXPECT_EQ(refusal("/dev/video97"), "/dev/video97: cannot open: No such file or directory");
  EXPECT_EQ(refusal("/dev/null"), "/dev/null: is no camera that can be opened");
  const test::Folder folder;
  const std::string file = folder.with("video0", "x").string();
  EXPECT_EQ(refusal(file), file + ": is no camera");
}

TEST(NewestFrame, WaitsForAFrameThatIsNewEnough) {
  std::atomic<int> given = 0;
  NewestFrame camera(made([&](int index, formats::Image& picture) {
                       while (given <= index) std::this_thread::sleep_for(1ms);
                       picture.pixels[0] = static_cast<std::uint8_t>(index);
                       return true;
                     }),
                     "camera");
  given = 1;
  while (camera.status().frames < 1) std::this_thread::sleep_for(1ms);
  const double since = steady_seconds();
  given = 2;
  LiveFrame frame;
  ASSERT_TRUE(camera.wait(frame, 10, since));
  EXPECT_EQ(frame.frame.index, 1);
  EXPECT_GE(frame.taken, since);
  given = 3;
  while (camera.status().frames < 3) std::this_thread::sleep_for(1ms);
  ASSERT_TRUE(camera.wait(frame, 0.01, steady_seconds() + 100));  // none comes: the newest there is
  EXPECT_EQ(frame.frame.index, 2);
  given = 1000;
}

}  // namespace
}  // namespace microswarm::vision
