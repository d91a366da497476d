// SPDX-License-Identifier: Apache-2.0
// A rig in real time against a simulated rig, with coils and a camera that can be made to fail.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <thread>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/rig/runtime/live_rig.hpp"
#include "microswarm/rig/runtime/realtime_rig_simulator.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"
#include "microswarm/vision/image/threads.hpp"
#include "tests/cases.hpp"
#include "tests/runs.hpp"

namespace microswarm::test {

/// Coils that remember what they were told, and fail when they are asked to.
class WatchedCoils : public actuation::CoilDriver {
 public:
  struct Log {
    std::atomic<double> strongest = 0;  // [A], of the last currents
    std::atomic<int> drives = 0;
    std::atomic<int> stops = 0;
    std::atomic<actuation::DriveStatus> answer = actuation::DriveStatus::driven;
    std::atomic<bool> dead = false;       // the amplifiers give nothing
    std::atomic<bool> exchanged = false;  // the first two coils
  };
  explicit WatchedCoils(std::shared_ptr<Log> log) : log_(std::move(log)) {}

  actuation::Capabilities capabilities() const override { return {.channels = 6}; }
  const actuation::DeviceReport& report() const override { return report_; }
  actuation::DriveStatus drive(const actuation::CoilRequest& request) override {
    const auto currents = std::get<std::span<const double>>(request);
    ++log_->drives;
    const actuation::DriveStatus answer = log_->answer;
    if (answer != actuation::DriveStatus::driven && answer != actuation::DriveStatus::resumed)
      return answer;
    std::array<double, 6> made{};
    std::copy(currents.begin(), currents.end(), made.begin());
    if (log_->exchanged) std::swap(made[0], made[1]);
    if (log_->dead) made = {};
    set(made);
    return answer;
  }
  actuation::StopReport stop() noexcept override {
    ++log_->stops;
    set(std::array<double, 6>{});
    return {.confirmed = true};
  }

 private:
  void set(std::span<const double> currents) {
    double most = 0;
    for (std::size_t i = 0; i < currents.size(); ++i) {
      report_.currents[i] = currents[i];
      most = std::max(most, std::abs(currents[i]));
    }
    log_->strongest = most;
  }
  std::shared_ptr<Log> log_;
  actuation::DeviceReport report_{.currents = std::vector<double>(6)};
};

/// A camera between the simulator and the rig that can be made to fail.
class TroubledCamera : public vision::FrameSource {
 public:
  struct Trouble {
    std::atomic<bool> drop = false, freeze = false, black = false, unplug = false, no_swarm = false,
                      jump = false, cycle = false, split = false;
    std::atomic<double> late = 0;  // [s]
  };
  TroubledCamera(std::unique_ptr<vision::FrameSource> camera, std::shared_ptr<Trouble> trouble)
      : camera_(std::move(camera)), trouble_(std::move(trouble)) {}

  bool next(vision::VideoFrame& frame) override {
    do {
      if (trouble_->unplug) throw HardwareError("camera: unplugged");
      if (!camera_->next(frame)) return false;
    } while (trouble_->drop && frame.index % 4 != 0);
    if (trouble_->freeze && !still_.pixels.empty()) frame.picture = still_;
    if (trouble_->cycle && !still_.pixels.empty()) {
      if (ring_.size() < 3) ring_.push_back(frame.picture);
      frame.picture = ring_[static_cast<std::size_t>(frame.index) % ring_.size()];
    }
    if (trouble_->split) cut(frame.picture);
    still_ = frame.picture;
    if (trouble_->black) paint(frame.picture, 0, {}, 1e9);
    if (trouble_->no_swarm) paint(frame.picture, still_.pixels[still_.index(60, 60)], {}, 1e9);
    if (trouble_->jump) frame.t -= 1e6;
    if (trouble_->late > 0)
      std::this_thread::sleep_for(std::chrono::duration<double>(trouble_->late));
    return true;
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return camera_->rate(); }

 private:
  static void paint(formats::Image& picture, std::uint8_t grey, Vec2 at, double radius) {
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column)
        if (distance(at, Vec2{1.0 * column, 1.0 * row}) <= radius)
          picture.pixels[picture.index(column, row)] = grey;
    // A picture of a camera is never twice the same.
    if (grey > 0) picture.pixels[static_cast<std::size_t>(count_++ % 1000)] ^= 1;
  }
  /// Cuts what is darkest in two and draws the halves apart.
  static void cut(formats::Image& picture) {
    constexpr int apart = 8, away = 50;
    Vec2 sum;
    double count = 0;
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column)
        if (picture.pixels[picture.index(column, row)] < 70) {
          sum += Vec2{1.0 * column, 1.0 * row};
          ++count;
        }
    const int middle = static_cast<int>(sum.x / count);
    const int height = static_cast<int>(sum.y / count);
    for (int row = height - 30; row < height + 30; ++row) {
      std::uint8_t* pixel = &picture.pixels[picture.index(middle, row)];
      for (int off = 40; off >= 0; --off) {
        pixel[off] = pixel[off < apart ? away : off - apart];
        pixel[-off - 1] = pixel[off < apart ? -away : -off - 1 + apart];
      }
    }
  }
  static inline std::atomic<int> count_ = 0;
  std::unique_ptr<vision::FrameSource> camera_;
  std::shared_ptr<Trouble> trouble_;
  formats::Image still_;
  std::vector<formats::Image> ring_;
};

class LiveRigs : public ::testing::Test {
 protected:
  LiveRigs() {
    vision::set_picture_threads(1);  // as `rig run` does
    const std::filesystem::path scenarios =
        std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";
    scene = experiment::load_scene(
        experiment::read_scenario(scenarios / "papers/radar/single.yaml"), scenarios);
    scene.scenario.obstacles.clear();
    scene.scenario.time_limit = 30;
    world = experiment::build_world(scene);
    rig.emplace(rig::read_rig(scenarios / "rigs/vortex.yaml",
                              {"camera.type=simulated", "camera.microscope.um_per_px=6"}));
    // A busy computer stalls: a test sets the limit that it is about.
    rig->params.safety = {
        .lost_swarm = 3, .max_frame_age = 3, .deadman = 3, .missed_deadlines = 100, .max_pause = 3};
  }

  /// Runs until `seconds` have passed or it ends; `then` is called after 0.5 s.
  experiment::RunResult go(double seconds, const std::function<void(rig::LiveRig&)>& then = {}) {
    const experiment::Scenario& s = scene.scenario;
    rig::RealtimeRigSimulator simulator(s, world, *rig, std::make_unique<WatchedCoils>(coils));
    rig::LiveRig plant(s, world.map, *rig,
                       std::make_unique<TroubledCamera>(simulator.camera(40), trouble),
                       turned(simulator.view().scale), simulator.coils());
    const auto navigator = navigation::make_navigator(s.navigator, experiment::navigation_task(s),
                                                      Rng(s.seed, Purpose::planner, 0));
    std::atomic<bool> over = false;
    std::thread trouble_maker([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      driven = coils->strongest;
      began = steady_seconds();
      if (then) then(plant);
      while (coils->strongest > 0 && !over)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      zero_after = steady_seconds() - began;
    });
    const experiment::RunResult result =
        test::run(s, plant, *navigator, {},
                  Stop(std::chrono::duration_cast<Stop::Clock::duration>(
                      std::chrono::duration<double>(seconds))));
    timing = plant.timing();
    kind = plant.fault_kind();
    at_end = coils->strongest;
    position = simulator.swarm().pose.position;
    over = true;
    trouble_maker.join();
    if (then) std::printf("coils at zero after %.3f s\n", zero_after);
    return result;
  }

  /// Why a run ended as a fault, with the coils at zero.
  std::string fault_of(const experiment::RunResult& result) const {
    EXPECT_EQ(result.status, Status::fault);
    EXPECT_EQ(at_end, 0);
    return result.state;
  }

  /// The scale of a camera that is turned by `turn` about the start, and not known to be.
  vision::CameraScale turned(vision::CameraScale scale) const {
    const Vec2 start_px = scale.to_picture(scene.scenario.start->position);
    scale.rotation += turn;
    scale.origin_px += start_px - scale.to_picture(scene.scenario.start->position);
    return scale;
  }

  double turn = 0;  // [rad]
  experiment::Scene scene;
  World world;
  std::optional<rig::Rig> rig;
  std::shared_ptr<WatchedCoils::Log> coils = std::make_shared<WatchedCoils::Log>();
  std::shared_ptr<TroubledCamera::Trouble> trouble = std::make_shared<TroubledCamera::Trouble>();
  double driven = 0;      // [A], before the trouble
  double began = 0;       // the trouble
  double zero_after = 0;  // [s] it took until the coils were at zero
  double at_end = -1;     // [A], when the run has ended
  Vec2 position;
  rig::RigTiming timing;
  rig::FaultKind kind = rig::FaultKind::none;
};

/// How much later than meant coils may be at zero here: tests share the computer.
inline constexpr double patience = sanitized ? 5 : 2;

}  // namespace microswarm::test
