// SPDX-License-Identifier: Apache-2.0
// Runs in real time against a simulated bench, and what happens when something fails.
#include "microswarm/rig/runtime/live_rig.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <thread>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/run/run.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/rig/runtime/realtime_rig_simulator.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"
#include "tests/cases.hpp"
#include "tests/files.hpp"

namespace microswarm {
namespace {

namespace fs = std::filesystem;

/// Coils that remember what they were told, and fail when they are asked to.
class WatchedCoils : public CoilDriver {
 public:
  struct Log {
    std::atomic<double> strongest = 0;  // [A], of the last currents
    std::atomic<int> drives = 0;
    std::atomic<int> stops = 0;
    std::atomic<DriveStatus> answer = DriveStatus::driven;
    std::atomic<bool> dead = false;       // the amplifiers give nothing
    std::atomic<bool> exchanged = false;  // the first two coils
  };
  explicit WatchedCoils(std::shared_ptr<Log> log) : log_(std::move(log)) {}

  int channels() const override { return 6; }
  std::span<const double> currents() const override { return currents_; }
  DriveStatus drive(std::span<const double> currents) override {
    ++log_->drives;
    const DriveStatus answer = log_->answer;
    if (answer != DriveStatus::driven && answer != DriveStatus::resumed) return answer;
    std::array<double, 6> made{};
    std::copy(currents.begin(), currents.end(), made.begin());
    if (log_->exchanged) std::swap(made[0], made[1]);
    if (log_->dead) made = {};
    set(made);
    return answer;
  }
  bool stop() noexcept override {
    ++log_->stops;
    set(std::array<double, 6>{});
    return true;
  }

 private:
  void set(std::span<const double> currents) {
    double most = 0;
    for (std::size_t i = 0; i < currents_.size(); ++i) {
      currents_[i] = currents[i];
      most = std::max(most, std::abs(currents[i]));
    }
    log_->strongest = most;
  }
  std::shared_ptr<Log> log_;
  std::array<double, 6> currents_{};
};

/// A camera between the bench and the rig that can be made to fail.
class TroubledCamera : public FrameSource {
 public:
  struct Trouble {
    std::atomic<bool> drop = false, freeze = false, black = false, unplug = false, no_swarm = false,
                      jump = false, cycle = false;
    std::atomic<double> late = 0;  // [s]
  };
  TroubledCamera(std::unique_ptr<FrameSource> camera, std::shared_ptr<Trouble> trouble)
      : camera_(std::move(camera)), trouble_(std::move(trouble)) {}

  bool next(VideoFrame& frame) override {
    do {
      if (trouble_->unplug) throw HardwareError("camera: unplugged");
      if (!camera_->next(frame)) return false;
    } while (trouble_->drop && frame.index % 4 != 0);
    if (trouble_->freeze && !still_.pixels.empty()) frame.picture = still_;
    if (trouble_->cycle && !still_.pixels.empty()) {
      if (ring_.size() < 3) ring_.push_back(frame.picture);
      frame.picture = ring_[static_cast<std::size_t>(frame.index) % ring_.size()];
    }
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
  static void paint(Image& picture, std::uint8_t grey, Vec2 at, double radius) {
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column)
        if (distance(at, Vec2{1.0 * column, 1.0 * row}) <= radius)
          picture.pixels[picture.index(column, row)] = grey;
    // A picture of a camera is never twice the same.
    if (grey > 0) picture.pixels[static_cast<std::size_t>(count_++ % 1000)] ^= 1;
  }
  static inline std::atomic<int> count_ = 0;
  std::unique_ptr<FrameSource> camera_;
  std::shared_ptr<Trouble> trouble_;
  Image still_;
  std::vector<Image> ring_;
};

class LiveRigs : public testing::Test {
 protected:
  LiveRigs() {
    const fs::path scenarios = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios";
    scene = load_scene(read_scenario(scenarios / "papers/radar/single.yaml"), scenarios);
    scene.scenario.obstacles.clear();
    scene.scenario.time_limit = 30;
    world = build_world(scene);
    rig.emplace(read_rig(scenarios / "rigs/vortex.yaml",
                         {"camera.type=simulated", "camera.microscope.um_per_px=6"}));
    // A busy computer stalls: a test sets the limit that it is about.
    rig->params.safety = {
        .lost_swarm = 3, .max_frame_age = 3, .deadman = 3, .missed_deadlines = 100, .max_pause = 3};
  }

  /// Runs until `seconds` have passed or it ends; `then` is called after 0.5 s.
  RunResult go(double seconds, const std::function<void(LiveRig&)>& then = {}) {
    const Scenario& s = scene.scenario;
    RealtimeRigSimulator bench(s, world, *rig, std::make_unique<WatchedCoils>(coils));
    LiveRig plant(s, world.map, *rig, std::make_unique<TroubledCamera>(bench.camera(40), trouble),
                  turned(bench.view().scale), bench.coils());
    const auto navigator =
        make_navigator(s.navigator, task_of(s), Rng(s.seed, Purpose::planner, 0));
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
    const RunResult result = run(s, plant, *navigator, {},
                                 Stop(std::chrono::duration_cast<Stop::Clock::duration>(
                                     std::chrono::duration<double>(seconds))));
    timing = plant.timing();
    at_end = coils->strongest;
    place = bench.swarm().pose.position;
    over = true;
    trouble_maker.join();
    if (then) std::printf("coils at zero after %.3f s\n", zero_after);
    return result;
  }

  /// The scale of a camera that is turned by `turn` about the start, and not known to be.
  CameraScale turned(CameraScale scale) const {
    const Vec2 start_px = scale.to_picture(scene.scenario.start->position);
    scale.rotation += turn;
    scale.origin_px += start_px - scale.to_picture(scene.scenario.start->position);
    return scale;
  }

  double turn = 0;  // [rad]
  Scene scene;
  World world;
  std::optional<Rig> rig;
  std::shared_ptr<WatchedCoils::Log> coils = std::make_shared<WatchedCoils::Log>();
  std::shared_ptr<TroubledCamera::Trouble> trouble = std::make_shared<TroubledCamera::Trouble>();
  double driven = 0;      // [A], before the trouble
  double began = 0;       // the trouble
  double zero_after = 0;  // [s] it took until the coils were at zero
  double at_end = -1;     // [A], when the run has ended
  Vec2 place;
  RigTiming timing;
};

/// How much later than meant coils may be at zero here: tests share the computer.
constexpr double patience = test::sanitized ? 5 : 2;

TEST_F(LiveRigs, DrivesTheSwarmInRealTime) {
  const Vec2 start = scene.scenario.start->position;
  const RunResult result = go(3);
  EXPECT_EQ(result.status, Status::stopped);
  EXPECT_GT(driven, 0.1);
  // 10 pictures and 200 sendings a second are meant, far fewer come on a busy computer.
  EXPECT_GT(distance(place, start), 0.1 * 3 * limits_of(scene.scenario.swarm).max_speed);
  EXPECT_GE(timing.frames, 3);
  EXPECT_GE(coils->drives, 30);
  EXPECT_LE(coils->drives, 700);
  EXPECT_GE(coils->stops, 1);  // when all is over
}

TEST_F(LiveRigs, DroppedFramesAreNoFault) {
  trouble->drop = true;
  EXPECT_EQ(go(2).status, Status::stopped);
}

TEST_F(LiveRigs, FrozenPicturesEndIt) {
  const RunResult result = go(6, [&](LiveRig&) { trouble->freeze = true; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "the camera's pictures are frozen");
  EXPECT_EQ(at_end, 0);
  EXPECT_LT(zero_after, patience * 0.8);
}

TEST_F(LiveRigs, PicturesThatComeAgainAndAgainEndIt) {
  const RunResult result = go(6, [&](LiveRig&) { trouble->cycle = true; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "the camera's pictures are frozen");
  EXPECT_EQ(at_end, 0);
  EXPECT_LT(zero_after, patience * 0.8);
}

TEST_F(LiveRigs, ADeviceThatTripsAgainEndsIt) {
  const RunResult result = go(6, [&](LiveRig&) { coils->answer = DriveStatus::resumed; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "the coils had been off by themselves 2 times in 10 s, allowed 1");
  EXPECT_EQ(at_end, 0);
  EXPECT_EQ(timing.resumed, 2);
  EXPECT_LT(zero_after, patience * 0.1);
}

TEST_F(LiveRigs, OneTripIsNoFault) {
  const RunResult result = go(2, [&](LiveRig&) {
    coils->answer = DriveStatus::resumed;
    const int before = coils->drives;
    while (coils->drives == before) std::this_thread::yield();
    coils->answer = DriveStatus::driven;
  });
  EXPECT_LE(timing.resumed, 2);
  EXPECT_EQ(result.status, timing.resumed == 1 ? Status::stopped : Status::fault);
}

TEST_F(LiveRigs, DeadAmplifiersEndIt) {
  rig->params.safety.follow_distance = 60;
  const RunResult result = go(20, [&](LiveRig&) { coils->dead = true; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_NE(result.state.find("the swarm does not follow: of 6"), std::string::npos)
      << result.state;
}

TEST_F(LiveRigs, ExchangedCoilsEndIt) {
  rig->params.safety.follow_distance = 60;
  coils->exchanged = true;
  const RunResult result = go(20, [&](LiveRig&) {});
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_NE(result.state.find("the swarm does not follow: of 6"), std::string::npos)
      << result.state;
  EXPECT_EQ(at_end, 0);
}

TEST_F(LiveRigs, ATurnedCameraEndsIt) {
  rig->params.safety.follow_distance = 60;
  scene.scenario.start->position = {1000, 900};
  scene.scenario.goal = Vec2{1300, 1100};
  for (const double angle : {90.0, 180.0}) {
    turn = angle * pi / 180;
    const RunResult result = go(20, [](LiveRig&) {});
    EXPECT_EQ(result.status, Status::fault) << angle;
    EXPECT_NE(result.state.find("the swarm does not follow: of 6"), std::string::npos)
        << result.state;
    EXPECT_EQ(at_end, 0);
  }
}

TEST_F(LiveRigs, ASlightlyTurnedCameraIsToldByItsAngle) {
  rig->params.safety.follow_distance = 60;
  scene.scenario.start->position = {1000, 900};
  scene.scenario.goal = Vec2{1600, 1100};
  for (const double angle : {0.0, 20.0}) {
    turn = angle * pi / 180;
    EXPECT_EQ(go(8).status, Status::stopped);
    ASSERT_TRUE(timing.direction);
    const double seen = degrees(timing.direction->angle);
    const double sd = degrees(timing.direction->sd);
    std::printf("turned by %.0f degrees: seen %.1f +- %.1f, %.0f %% of the way\n", angle, seen, sd,
                100 * timing.direction->share);
    EXPECT_NEAR(seen, angle, std::max(6.0, 4 * sd));
    EXPECT_LT(sd, 10);
  }
}

TEST_F(LiveRigs, BlackPicturesEndIt) {
  const RunResult result = go(6, [&](LiveRig&) { trouble->black = true; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "the camera's pictures are black");
  EXPECT_EQ(at_end, 0);
  EXPECT_LT(zero_after, patience * 0.8);
}

TEST_F(LiveRigs, PicturesThatComeTwoSecondsLateEndIt) {
  rig->params.safety.max_frame_age = 0.5;
  const RunResult result = go(6, [&](LiveRig&) { trouble->late = 2; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_NE(result.state.find("s old, allowed 0.5 s"), std::string::npos) << result.state;
  EXPECT_EQ(at_end, 0);
  EXPECT_LT(zero_after, patience * 1.2);
}

TEST_F(LiveRigs, ASwarmThatLeavesThePictureEndsIt) {
  rig->params.safety.lost_swarm = 0.5;
  const RunResult result = go(6, [&](LiveRig&) { trouble->no_swarm = true; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_NE(result.state.find("the swarm was not found for"), std::string::npos) << result.state;
  EXPECT_EQ(at_end, 0);
  EXPECT_LT(zero_after, patience * 1.2);
}

TEST_F(LiveRigs, AnUnpluggedCameraEndsIt) {
  const RunResult result = go(6, [&](LiveRig&) { trouble->unplug = true; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "camera: unplugged");
  EXPECT_EQ(at_end, 0);
  EXPECT_LT(zero_after, patience * 0.8);
}

TEST_F(LiveRigs, ASilentCoilDriverEndsIt) {
  const RunResult result = go(6, [&](LiveRig&) { coils->answer = DriveStatus::no_answer; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "the coil driver does not answer");
  EXPECT_EQ(at_end, 0);
}

TEST_F(LiveRigs, RefusedCurrentsEndIt) {
  const RunResult result = go(6, [&](LiveRig&) { coils->answer = DriveStatus::refused; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "the coil driver refuses the currents");
  EXPECT_EQ(at_end, 0);
}

TEST_F(LiveRigs, ADeviceThatStaysOffEndsIt) {
  const RunResult result = go(6, [&](LiveRig&) { coils->answer = DriveStatus::not_armed; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "the coils' device is off and does not let itself be armed");
  EXPECT_EQ(at_end, 0);
}

TEST_F(LiveRigs, TimesInFramesThatJumpDoNotMatter) {
  EXPECT_EQ(go(2, [&](LiveRig&) { trouble->jump = true; }).status, Status::stopped);
}

TEST_F(LiveRigs, TheEmergencyStopComesAtOnceFromAnyThread) {
  const RunResult result = go(6, [&](LiveRig& plant) { plant.stop("key"); });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "key");
  EXPECT_LT(zero_after, patience * 0.1);
}

/// Thinks for longer than it may.
class Slow : public Navigator {
 public:
  Command step(const Observation&, const Stop&) override {
    std::this_thread::sleep_for(std::chrono::duration<double>(++steps_ > 3 ? 1.5 : 0.0));
    return {0, 30};
  }
  NavigatorView view() const override { return {}; }

 private:
  int steps_ = 0;
};

TEST_F(LiveRigs, ANavigatorThatHangsEndsIt) {
  rig->params.safety.deadman = 0.5;
  const Scenario& s = scene.scenario;
  RealtimeRigSimulator bench(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  LiveRig plant(s, world.map, *rig, bench.camera(40), bench.view().scale, bench.coils());
  Slow slow;
  const RunResult result = run(s, plant, slow);
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_NE(result.state.find("no command for 0.5"), std::string::npos) << result.state;
  EXPECT_EQ(coils->strongest, 0);
}

TEST_F(LiveRigs, ALogThatCannotBeWrittenEndsIt) {
  const Scenario& s = scene.scenario;
  RealtimeRigSimulator bench(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  int moments = 0;
  LiveRig plant(s, world.map, *rig, bench.camera(40), bench.view().scale, bench.coils(),
                [&](const CoilMoment&) {
                  if (++moments > 50) throw InputError("commands.csv: cannot write: disk full");
                });
  const auto navigator = make_navigator(s.navigator, task_of(s), Rng(1, Purpose::planner, 0));
  const RunResult result = run(s, plant, *navigator);
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "commands.csv: cannot write: disk full");
  EXPECT_EQ(coils->strongest, 0);
}

TEST_F(LiveRigs, ADeadmanShorterThanATickIsRefused) {
  rig->params.safety.deadman = 0.1;
  const std::string error = test::error_of([&] { go(1); });
  EXPECT_TRUE(
      error.ends_with(": safety.deadman_s is 0.1, a tick of the scenario 0.1 s: it must be "
                      "at least twice that"))
      << error;
}

TEST_F(LiveRigs, AGoalOutsideThePictureIsRefused) {
  const Scenario& s = scene.scenario;
  RealtimeRigSimulator bench(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  CameraScale near = bench.view().scale;
  near.um_per_px /= 2;
  const std::string error =
      test::error_of([&] { LiveRig(s, world.map, *rig, bench.camera(40), near, bench.coils()); });
  EXPECT_NE(error.find("µm of the scenario is at pixel ("), std::string::npos) << error;
  EXPECT_NE(error.find(", outside the picture of "), std::string::npos) << error;
  EXPECT_EQ(coils->drives, 0);
}

TEST_F(LiveRigs, ObstaclesOfTheScenarioAreVirtualBesideThoseOfARealCamera) {
  Rig bench_rig = *rig;
  bench_rig.params.camera = VideoCamera{};
  Scenario s = scene.scenario;
  Straight motion{.start = s.start->position + Vec2{400, 300}, .velocity = {0, -30}};
  s.obstacles = {{DiscShape{80}, motion}};
  RealtimeRigSimulator bench(scene.scenario, world, *rig, std::make_unique<WatchedCoils>(coils));
  {
    LiveRig plant(s, world.map, bench_rig, bench.camera(40), bench.view().scale, bench.coils());
    const Observation first = plant.observe();
    ASSERT_EQ(first.world->moving().bodies().size(), 1u);
    const Body& body = first.world->moving().bodies()[0];
    EXPECT_EQ(body.obstacle, 0u);
    EXPECT_NEAR(distance(extent_of(body).centre, motion.start + first.seen * motion.velocity), 0,
                1e-9);
    EXPECT_TRUE(plant.set_obstacles({}));
    EXPECT_TRUE(plant.observe().world->moving().empty());
  }
  bench_rig.params.virtual_obstacles = false;
  LiveRig plant(s, world.map, bench_rig, bench.camera(40), bench.view().scale, bench.coils());
  EXPECT_TRUE(plant.observe().world->moving().empty());
  EXPECT_FALSE(plant.set_obstacles(s.obstacles));
}

TEST_F(LiveRigs, AVirtualObstacleInTheWayIsAvoided) {
  Rig bench_rig = *rig;
  bench_rig.params.camera = VideoCamera{};
  const Pose2 start = *scene.scenario.start;
  const Vec2 ahead = *scene.scenario.goal - start.position;
  Scenario s = scene.scenario;
  s.obstacles = {{DiscShape{60}, Straight{.start = start.position + (220 / norm(ahead)) * ahead}}};
  RealtimeRigSimulator bench(scene.scenario, world, *rig, std::make_unique<WatchedCoils>(coils));
  LiveRig plant(s, world.map, bench_rig, bench.camera(40), bench.view().scale, bench.coils());
  const auto navigator = make_navigator(s.navigator, task_of(s), Rng(s.seed, Purpose::planner, 0));
  const RunResult result = run(s, plant, *navigator, {}, Stop(std::chrono::seconds(12)));
  EXPECT_EQ(result.status, Status::stopped) << result.state;
  EXPECT_GT(result.metrics.obstacles.clearance, 60);
  EXPECT_LT(result.metrics.obstacles.clearance, 240);
}

/// Gives one picture, then fails.
class OnePicture : public FrameSource {
 public:
  explicit OnePicture(Image picture) : picture_(std::move(picture)) {}
  bool next(VideoFrame& frame) override {
    if (given_) throw HardwareError("camera: gone");
    frame.picture = picture_;
    return given_ = true;
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return std::nullopt; }

 private:
  Image picture_;
  bool given_ = false;
};

TEST_F(LiveRigs, ACameraThatFailsAtTheStartEndsIt) {
  const Scenario& s = scene.scenario;
  RealtimeRigSimulator bench(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  const auto camera = bench.camera(40);
  VideoFrame first;
  ASSERT_TRUE(camera->next(first));
  LiveRig plant(s, world.map, *rig, std::make_unique<OnePicture>(first.picture), bench.view().scale,
                bench.coils());
  const auto navigator = make_navigator(s.navigator, task_of(s), Rng(1, Purpose::planner, 0));
  const RunResult result = run(s, plant, *navigator);
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "camera: gone");
}

}  // namespace
}  // namespace microswarm
