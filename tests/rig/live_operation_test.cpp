// SPDX-License-Identifier: Apache-2.0
// A rig in real time that is paused or steered by hand while its camera fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "microswarm/experiment/session/session.hpp"
#include "microswarm/rig/runtime/live_rig.hpp"
#include "microswarm/rig/runtime/realtime_rig_simulator.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

/// A camera whose pictures freeze, or show no swarm any more.
class FailingCamera : public vision::FrameSource {
 public:
  FailingCamera(std::unique_ptr<vision::FrameSource> camera, const std::atomic<bool>& freezes,
                const std::atomic<bool>& loses)
      : camera_(std::move(camera)), freezes_(freezes), loses_(loses) {}
  bool next(vision::VideoFrame& frame) override {
    if (!camera_->next(frame)) return false;
    if (freezes_) frame.picture = last_;
    last_ = frame.picture;
    auto& pixels = frame.picture.pixels;
    if (loses_) std::ranges::fill(pixels, pixels[frame.picture.index(60, 60)]);
    if (loses_) pixels[static_cast<std::size_t>(frame.index % 1000)] ^= 1;  // not frozen
    return true;
  }
  std::optional<int> count() const override { return std::nullopt; }
  std::optional<double> rate() const override { return camera_->rate(); }

 private:
  std::unique_ptr<vision::FrameSource> camera_;
  const std::atomic<bool>& freezes_;
  const std::atomic<bool>& loses_;
  formats::Image last_;
};

class LiveOperation : public testing::Test {
 protected:
  LiveOperation() {
    rig.params.safety = {.lost_swarm = 0.5,
                         .max_frame_age = 3,
                         .deadman = 3,
                         .missed_deadlines = 100,
                         .max_pause = 3};
  }
  /// Runs for 8 s at most; `then` is called after 0.5 s.
  experiment::RunResult go(const std::function<void(experiment::Operation&)>& then) {
    const experiment::Scene scene =
        experiment::load_scene(experiment::read_scenario(scenarios / "papers/radar/single.yaml",
                                                         {"obstacles=[]", "time_limit_s=30"}),
                               scenarios);
    const experiment::Scenario& s = scene.scenario;
    const World world = experiment::build_world(scene);
    RealtimeRigSimulator simulator(s, world, rig,
                                   std::make_unique<actuation::SimulatedCoilDriver>(6, 20));
    LiveRig plant(s, world.map, rig,
                  std::make_unique<FailingCamera>(simulator.camera(40), freezes, loses),
                  simulator.view().scale, simulator.coils());
    experiment::Session session({scene, world, {}}, {.plant = borrowed(plant)});
    std::thread person([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      then(*session.operation());
    });
    const experiment::RunResult result = session.finish(Stop(std::chrono::seconds(8)));
    person.join();
    for (const double current : simulator.coils().report().currents) EXPECT_EQ(current, 0);
    return result;
  }

  const fs::path scenarios = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  Rig rig = read_rig(scenarios / "rigs/vortex.yaml",
                     {"camera.type=simulated", "camera.microscope.um_per_px=6"});
  std::atomic<bool> freezes = false, loses = false;
};

TEST_F(LiveOperation, ALostSwarmEndsAPauseToo) {
  const experiment::RunResult result = go([&](experiment::Operation& operation) {
    operation.pause();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    loses = true;
  });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_TRUE(result.state.starts_with("the swarm was not found")) << result.state;
}

TEST_F(LiveOperation, FrozenPicturesEndTheSteeringByHandToo) {
  const experiment::RunResult result = go([&](experiment::Operation& operation) {
    operation.manual();
    operation.steer({0, 20});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    freezes = true;
  });
  EXPECT_EQ(result.status, Status::fault);
  EXPECT_EQ(result.state, "the camera's pictures are frozen");
}

}  // namespace
}  // namespace microswarm::rig
