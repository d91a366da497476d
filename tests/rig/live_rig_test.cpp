// SPDX-License-Identifier: Apache-2.0
// Runs in real time against a simulated rig, and what happens when something fails.
#include "tests/rig/live_rigs.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/execution/priority.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/rig/runtime/live_rig.hpp"
#include "microswarm/rig/runtime/realtime_rig_simulator.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::rig {
namespace {

using test::LiveRigs;
using test::names;
using test::patience;
using test::WatchedCoils;

TEST_F(LiveRigs, DrivesTheSwarmInRealTime) {
  const Vec2 start = scene.scenario.start->position;
  const experiment::RunResult result = go(3);
  EXPECT_EQ(result.status, Status::stopped);
  EXPECT_GT(driven, 0.1);
  // 10 pictures and 200 sendings a second are meant, far fewer come on a busy computer.
  EXPECT_GT(distance(position, start), 0.1 * 3 * swarm_limits(scene.scenario.swarm).max_speed);
  EXPECT_GE(timing.frames, 3);
  EXPECT_GE(coils->drives, 30);
  EXPECT_LE(coils->drives, 700);
  EXPECT_GE(coils->stops, 1);  // when all is over
  EXPECT_GE(timing.camera_to_current.count(), 3u);
  EXPECT_LE(timing.camera_to_current.count(), static_cast<std::size_t>(timing.frames));
  EXPECT_GE(timing.camera_to_current.quantile(0.5), timing.vision.quantile(0));
}

TEST_F(LiveRigs, DroppedFramesAreNoFault) {
  trouble->drop = true;
  EXPECT_EQ(go(2).status, Status::stopped);
}

TEST_F(LiveRigs, FrozenPicturesEndIt) {
  const experiment::RunResult result = go(6, [&](LiveRig&) { trouble->freeze = true; });
  EXPECT_EQ(fault_of(result), "the camera's pictures are frozen");
  EXPECT_EQ(kind, FaultKind::camera);
  EXPECT_LT(zero_after, patience * 0.8);
}

TEST_F(LiveRigs, PicturesThatComeAgainAndAgainEndIt) {
  const experiment::RunResult result = go(6, [&](LiveRig&) { trouble->cycle = true; });
  EXPECT_EQ(fault_of(result), "the camera's pictures are frozen");
  EXPECT_LT(zero_after, patience * 0.8);
}

TEST_F(LiveRigs, ADeviceThatTripsAgainEndsIt) {
  const experiment::RunResult result =
      go(6, [&](LiveRig&) { coils->answer = actuation::DriveStatus::resumed; });
  EXPECT_EQ(fault_of(result),
            "the coils had switched off by themselves 2 times in 10 s, allowed 1");
  EXPECT_EQ(timing.resumed, 2);
  EXPECT_LT(zero_after, patience * 0.1);
}

TEST_F(LiveRigs, OneTripIsNoFault) {
  const experiment::RunResult result = go(2, [&](LiveRig&) {
    coils->answer = actuation::DriveStatus::resumed;
    const int before = coils->drives;
    while (coils->drives == before) std::this_thread::yield();
    coils->answer = actuation::DriveStatus::driven;
  });
  EXPECT_LE(timing.resumed, 2);
  EXPECT_EQ(result.status, timing.resumed == 1 ? Status::stopped : Status::fault);
}

TEST_F(LiveRigs, DeadAmplifiersEndIt) {
  rig->params.safety.follow_distance = 60;
  const experiment::RunResult result = go(20, [&](LiveRig&) { coils->dead = true; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_NE(result.state.find("the swarm does not follow: of 6"), std::string::npos)
      << result.state;
  EXPECT_EQ(kind, FaultKind::swarm);
}

TEST_F(LiveRigs, ExchangedCoilsEndIt) {
  rig->params.safety.follow_distance = 60;
  coils->exchanged = true;
  const experiment::RunResult result = go(20, [&](LiveRig&) {});
  EXPECT_TRUE(fault_of(result).starts_with("the swarm does not follow: of 6")) << result.state;
}

TEST_F(LiveRigs, ATurnedCameraEndsIt) {
  rig->params.safety.max_map_shift_px = 0;  // the walls would tell it first
  rig->params.safety.follow_distance = 60;
  scene.scenario.start->position = {1000, 900};
  scene.scenario.goal = Vec2{1300, 1100};
  for (const double angle : {90.0, 180.0}) {
    turn = angle * pi / 180;
    const experiment::RunResult result = go(20, [](LiveRig&) {});
    EXPECT_EQ(result.status, Status::fault) << angle;
    EXPECT_NE(result.state.find("the swarm does not follow: of 6"), std::string::npos)
        << result.state;
    EXPECT_EQ(at_end, 0);
  }
}

TEST_F(LiveRigs, ASlightlyTurnedCameraIsToldByItsAngle) {
  rig->params.safety.max_map_shift_px = 0;
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
  const experiment::RunResult result = go(6, [&](LiveRig&) { trouble->black = true; });
  EXPECT_EQ(fault_of(result), "the camera's pictures are black");
  EXPECT_LT(zero_after, patience * 0.8);
}

TEST_F(LiveRigs, PicturesThatComeTwoSecondsLateEndIt) {
  rig->params.safety.max_frame_age = 0.5;
  const experiment::RunResult result = go(6, [&](LiveRig&) { trouble->late = 2; });
  EXPECT_TRUE(names(fault_of(result), "s old, allowed 0.5 s")) << result.state;
  EXPECT_LT(zero_after, patience * 1.2);
}

TEST_F(LiveRigs, ASwarmThatLeavesThePictureEndsIt) {
  rig->params.safety.lost_swarm = 0.5;
  const experiment::RunResult result = go(6, [&](LiveRig&) { trouble->no_swarm = true; });
  EXPECT_TRUE(names(fault_of(result), "the swarm was not found for")) << result.state;
  EXPECT_EQ(kind, FaultKind::swarm);
  EXPECT_LT(zero_after, patience * 1.2);
  EXPECT_GE(timing.unseen_frames, 2);
}

TEST_F(LiveRigs, ASwarmThatSplitsEndsIt) {
  rig->params.safety.lost_swarm = 0.5;
  const experiment::RunResult result = go(6, [&](LiveRig&) { trouble->split = true; });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_NE(result.state.find("(it split into parts of "), std::string::npos) << result.state;
  EXPECT_NE(result.state.find(" and "), std::string::npos) << result.state;
  EXPECT_EQ(at_end, 0);
  EXPECT_LT(zero_after, patience * 1.2);
}

TEST_F(LiveRigs, AnUnpluggedCameraEndsIt) {
  const experiment::RunResult result = go(6, [&](LiveRig&) { trouble->unplug = true; });
  EXPECT_EQ(fault_of(result), "camera: unplugged");
  EXPECT_EQ(kind, FaultKind::camera);
  EXPECT_LT(zero_after, patience * 0.8);
}

TEST_F(LiveRigs, ASilentCoilDriverEndsIt) {
  const experiment::RunResult result =
      go(6, [&](LiveRig&) { coils->answer = actuation::DriveStatus::no_answer; });
  EXPECT_EQ(fault_of(result), "the coil driver does not answer");
  EXPECT_EQ(kind, FaultKind::device);
}

TEST_F(LiveRigs, RefusedCurrentsEndIt) {
  const experiment::RunResult result =
      go(6, [&](LiveRig&) { coils->answer = actuation::DriveStatus::refused; });
  EXPECT_EQ(fault_of(result), "the coil driver refuses the currents");
}

TEST_F(LiveRigs, ADeviceThatStaysOffEndsIt) {
  const experiment::RunResult result =
      go(6, [&](LiveRig&) { coils->answer = actuation::DriveStatus::not_armed; });
  EXPECT_EQ(fault_of(result), "the coils' device is off and does not let itself be armed");
}

TEST_F(LiveRigs, TimesInFramesThatJumpDoNotMatter) {
  EXPECT_EQ(go(2, [&](LiveRig&) { trouble->jump = true; }).status, Status::stopped);
}

TEST_F(LiveRigs, TheEmergencyStopComesAtOnceFromAnyThread) {
  const experiment::RunResult result = go(6, [&](LiveRig& plant) { plant.stop("key"); });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "key");
  EXPECT_EQ(kind, FaultKind::person);
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
  const experiment::Scenario& s = scene.scenario;
  RealtimeRigSimulator simulator(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  LiveRig plant(s, world.map, *rig, simulator.camera(40), simulator.view().scale,
                simulator.coils());
  Slow slow;
  const experiment::RunResult result = test::run(s, plant, slow);
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_NE(result.state.find("no command for 0.5"), std::string::npos) << result.state;
  EXPECT_EQ(coils->strongest, 0);
}

TEST_F(LiveRigs, ALogThatCannotBeWrittenEndsIt) {
  const experiment::Scenario& s = scene.scenario;
  RealtimeRigSimulator simulator(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  int moments = 0;
  LiveRig plant(s, world.map, *rig, simulator.camera(40), simulator.view().scale, simulator.coils(),
                {.coils = [&](const CoilMoment&) {
                  if (++moments > 50) throw WriteError("commands.csv: cannot write: disk full");
                }});
  const auto navigator = navigation::make_navigator(s.navigator, experiment::navigation_task(s),
                                                    Rng(1, Purpose::planner, 0));
  const experiment::RunResult result = test::run(s, plant, *navigator);
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "commands.csv: cannot write: disk full");
  EXPECT_EQ(plant.fault_kind(), FaultKind::disk);
  EXPECT_EQ(coils->strongest, 0);
}

TEST_F(LiveRigs, CameraCoilsAndTicksHaveTheRigsPriority) {
  rig->params.realtime_priority = 7;
  if (!RealtimePriority(7).is_permitted()) GTEST_SKIP() << "this user may have no such priority";
  const experiment::Scenario& s = scene.scenario;
  RealtimeRigSimulator simulator(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  std::atomic<int> of_coils = -1, of_camera = -1;
  {
    LiveRig plant(
        s, world.map, *rig, simulator.camera(40), simulator.view().scale, simulator.coils(),
        {.coils = [&](const CoilMoment&) { of_coils = realtime_priority(); },
         .pictures = [&](const vision::VideoFrame&, double) { of_camera = realtime_priority(); }});
    plant.observe();
    plant.apply({0, 30}, s.tick);
    plant.observe();
    EXPECT_EQ(realtime_priority(), 7);
  }
  EXPECT_EQ(realtime_priority(), 0);
  EXPECT_EQ(of_coils, 8);  // before the others
  EXPECT_EQ(of_camera, 7);
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
  const experiment::Scenario& s = scene.scenario;
  RealtimeRigSimulator simulator(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  vision::CameraScale near = simulator.view().scale;
  near.um_per_px /= 2;
  const std::string error = test::error_of(
      [&] { LiveRig(s, world.map, *rig, simulator.camera(40), near, simulator.coils()); });
  EXPECT_NE(error.find("µm of the scenario is at pixel ("), std::string::npos) << error;
  EXPECT_NE(error.find(", outside the picture of "), std::string::npos) << error;
  EXPECT_EQ(coils->drives, 0);
}

TEST_F(LiveRigs, ObstaclesOfTheScenarioAreVirtualBesideThoseOfARealCamera) {
  Rig bench_rig = *rig;
  bench_rig.params.camera = VideoCamera{};
  experiment::Scenario s = scene.scenario;
  Straight motion{.start = s.start->position + Vec2{400, 300}, .velocity = {0, -30}};
  s.obstacles = {{DiscShape{80}, motion}};
  RealtimeRigSimulator simulator(scene.scenario, world, *rig,
                                 std::make_unique<WatchedCoils>(coils));
  {
    LiveRig plant(s, world.map, bench_rig, simulator.camera(40), simulator.view().scale,
                  simulator.coils());
    const Observation first = plant.observe();
    ASSERT_EQ(first.world->moving().bodies().size(), 1u);
    const Body& body = first.world->moving().bodies()[0];
    EXPECT_EQ(body.obstacle, 0u);
    EXPECT_NEAR(distance(enclosing_disc(body).centre, motion.start + first.seen * motion.velocity),
                0, 1e-9);
    EXPECT_TRUE(plant.set_obstacles({}));
    EXPECT_TRUE(plant.observe().world->moving().empty());
  }
  bench_rig.params.virtual_obstacles = false;
  LiveRig plant(s, world.map, bench_rig, simulator.camera(40), simulator.view().scale,
                simulator.coils());
  EXPECT_TRUE(plant.observe().world->moving().empty());
  EXPECT_FALSE(plant.set_obstacles(s.obstacles));
}

TEST_F(LiveRigs, AVirtualObstacleInTheWayIsAvoided) {
  Rig bench_rig = *rig;
  bench_rig.params.camera = VideoCamera{};
  const Pose2 start = *scene.scenario.start;
  const Vec2 ahead = *scene.scenario.goal - start.position;
  experiment::Scenario s = scene.scenario;
  s.obstacles = {{DiscShape{60}, Straight{.start = start.position + (220 / norm(ahead)) * ahead}}};
  RealtimeRigSimulator simulator(scene.scenario, world, *rig,
                                 std::make_unique<WatchedCoils>(coils));
  LiveRig plant(s, world.map, bench_rig, simulator.camera(40), simulator.view().scale,
                simulator.coils());
  const auto navigator = navigation::make_navigator(s.navigator, experiment::navigation_task(s),
                                                    Rng(s.seed, Purpose::planner, 0));
  const experiment::RunResult result =
      test::run(s, plant, *navigator, {}, Stop(std::chrono::seconds(12)));
  EXPECT_EQ(result.status, Status::stopped) << result.state;
  EXPECT_GT(result.metrics.obstacles.clearance, 60);
  EXPECT_LT(result.metrics.obstacles.clearance, 240);
}

/// A device that makes waveforms and lets through a share of what it is told.
class WeakenedCoils : public actuation::CoilDriver {
 public:
  explicit WeakenedCoils(double share)
      : report_{.currents = std::vector<double>(6), .scale = share} {}
  actuation::Capabilities capabilities() const override {
    return {6, actuation::CoilInput::waveform};
  }
  const actuation::DeviceReport& report() const override { return report_; }
  actuation::DriveStatus drive(const actuation::CoilRequest& request) override {
    const auto* const waveform = std::get_if<actuation::CurrentWaveform>(&request);
    if (!waveform) return actuation::DriveStatus::refused;
    const double now = steady_seconds();
    if (!report_.phase) began_ = now - waveform->phase / (2 * pi * waveform->frequency);
    report_.phase = 2 * pi * waveform->frequency * (now - began_);
    return report_.scale < 1 ? actuation::DriveStatus::scaled : actuation::DriveStatus::driven;
  }
  actuation::StopReport stop() noexcept override {
    report_.phase.reset();
    return {.confirmed = true};
  }

 private:
  actuation::DeviceReport report_;
  double began_ = 0;  // [s], by steady_seconds()
};

TEST_F(LiveRigs, AWaveformThatTheDeviceWeakensMovesTheSwarmAsItsFieldDoes) {
  const experiment::Scenario& s = scene.scenario;
  const Vec2 start = s.start->position;
  const auto way = [&](double share) {
    RealtimeRigSimulator simulator(s, world, *rig, std::make_unique<WeakenedCoils>(share));
    LiveRig plant(s, world.map, *rig, simulator.camera(40), simulator.view().scale,
                  simulator.coils());
    const auto navigator = navigation::make_navigator(s.navigator, experiment::navigation_task(s),
                                                      Rng(1, Purpose::planner, 0));
    test::run(s, plant, *navigator, {}, Stop(std::chrono::seconds(2)));
    return distance(simulator.swarm().pose.position, start);
  };
  EXPECT_GT(way(0.5), 0.1 * 2 * swarm_limits(s.swarm).max_speed);  // 4 mT turn it as 8 do
  EXPECT_LT(way(0.03), 1);                                         // 0.24 mT turn nothing
}

/// Gives one picture, then fails.
class OnePicture : public vision::FrameSource {
 public:
  explicit OnePicture(formats::Image picture) : picture_(std::move(picture)) {}
  bool next(vision::VideoFrame& frame) override {
    if (given_) throw HardwareError("camera: gone");
    frame.picture = picture_;
    return given_ = true;
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return std::nullopt; }

 private:
  formats::Image picture_;
  bool given_ = false;
};

TEST_F(LiveRigs, ACameraThatFailsAtTheStartEndsIt) {
  const experiment::Scenario& s = scene.scenario;
  RealtimeRigSimulator simulator(s, world, *rig, std::make_unique<WatchedCoils>(coils));
  const auto camera = simulator.camera(40);
  vision::VideoFrame first;
  ASSERT_TRUE(camera->next(first));
  LiveRig plant(s, world.map, *rig, std::make_unique<OnePicture>(first.picture),
                simulator.view().scale, simulator.coils());
  const auto navigator = navigation::make_navigator(s.navigator, experiment::navigation_task(s),
                                                    Rng(1, Purpose::planner, 0));
  const experiment::RunResult result = test::run(s, plant, *navigator);
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "camera: gone");
}

}  // namespace
}  // namespace microswarm::rig
