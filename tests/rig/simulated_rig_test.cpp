// SPDX-License-Identifier: Apache-2.0
// Whole scenarios through camera, coils and field, beside the simulation without them.
#include "microswarm/rig/simulation/simulated_rig.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/make.hpp"
#include "tests/files.hpp"
#include "tests/runs.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

const fs::path scenarios = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios";

// Drawing and reading large pictures takes most of the time.
const std::vector<std::string> coarse{"camera.type=simulated", "camera.microscope.um_per_px=3"};

struct Rehearsal {
  experiment::Scene scene;
  World world;
  Rig rig;

  Rehearsal(const std::string& scenario, const std::string& rig_name,
            const std::vector<std::string>& rig_settings = {},
            const std::vector<std::string>& settings = {})
      : scene(
            experiment::load_scene(experiment::read_scenario(scenarios / scenario, {settings, ""}),
                                   (scenarios / scenario).parent_path())),
        world(experiment::build_world(scene)),
        rig(read_rig(scenarios / "rigs" / rig_name, {rig_settings, ""})) {}

  experiment::RunResult in_rig(SimulatedRig& plant,
                               std::span<experiment::RunListener* const> listeners = {}) const {
    const experiment::Scenario& s = scene.scenario;
    const auto navigator = navigation::make_navigator(s.navigator, experiment::navigation_task(s),
                                                      Rng(s.seed, Purpose::planner, 0));
    return test::run(s, plant, *navigator, listeners);
  }
  experiment::RunResult in_rig() const {
    SimulatedRig plant(scene.scenario, world, rig);
    return in_rig(plant);
  }
  experiment::RunResult without() const { return experiment::simulate(scene.scenario, world); }
};

struct Pair {
  const char* scenario;
  const char* rig;
  std::vector<std::string> rig_settings{};
};

class Rehearsals : public testing::TestWithParam<Pair> {};

TEST_P(Rehearsals, TheGoalIsReachedAboutAsFast) {
  const Rehearsal r(GetParam().scenario, GetParam().rig, GetParam().rig_settings);
  const experiment::RunResult plain = r.without();
  const experiment::RunResult whole = r.in_rig();
  EXPECT_EQ(plain.status, Status::solved);
  EXPECT_EQ(whole.status, Status::solved);
  EXPECT_LT(whole.metrics.time, 1.35 * plain.metrics.time);
  EXPECT_EQ(whole.metrics.contacts, 0);
  const double margin = navigation::required_clearance(r.scene.scenario.navigator);
  EXPECT_GE(plain.metrics.obstacles.clearance, margin);
  EXPECT_GE(whole.metrics.obstacles.clearance, margin);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Rehearsals,
                         testing::Values(Pair{"papers/radar/single.yaml", "vortex.yaml", coarse},
                                         Pair{"papers/drrt/s_channel.yaml", "ribbon.yaml"},
                                         Pair{"papers/drrt/moving_obstacles.yaml", "ribbon.yaml"},
                                         Pair{"papers/drrt/deforming_channel.yaml", "ribbon.yaml"},
                                         Pair{"oncoming.yaml", "ribbon.yaml"},
                                         Pair{"papers/gather/t_junction.yaml", "rollers.yaml"},
                                         Pair{"papers/global/two_robots.yaml", "rollers.yaml"}),
                         [](const auto& pair) {
                           return fs::path(pair.param.scenario).stem().string();
                         });

/// Counts the ticks in which the swarm waits for a valve.
class Waits : public experiment::RunListener {
 public:
  void on_tick(const experiment::Tick& tick) override {
    count += tick.frame.state == NavigatorState::wait;
  }
  int count = 0;
};

TEST(SimulatedRig, ItWaitsForAValveThatTheCameraSees) {
  // Before the first valve of the maze, which is about to close.
  const Rehearsal r("papers/radar/micromaze.yaml", "vortex.yaml",
                    {"camera.type=simulated", "camera.microscope.um_per_px=6"},
                    {"start.x_um=4600", "goal_um=[7000, 1125]", "obstacles.2.shape.phase=0.4",
                     "navigator.global_plan=false"});
  SimulatedRig plant(r.scene.scenario, r.world, r.rig);
  Waits waits;
  experiment::RunListener* const listener = &waits;
  const experiment::RunResult result = r.in_rig(plant, std::span(&listener, 1));
  EXPECT_EQ(result.status, Status::solved);
  EXPECT_EQ(result.metrics.contacts, 0);
  EXPECT_GT(waits.count * r.scene.scenario.tick, 10);  // [s]
}

TEST(SimulatedRig, AFaultOfARunEndsARehearsalToo) {
  struct Case {
    std::vector<std::string> rig_settings;
    std::vector<std::string> settings;
    std::string_view fault;
  };
  const Case cases[] = {
      {{"camera.microscope.light_drift=0.6", "camera.microscope.light_period_s=5"},
       {},
       "the swarm was not found for "},
      {{"safety.max_frame_age_s=0.2"},
       {"sensing.observation_delay_s=0.4", "sensing.frame_timeout_s=1"},
       "the newest picture is "},
      {{"camera.speed_error=-0.9"}, {}, "the swarm does not follow: of "}};
  for (const Case& c : cases) {
    std::vector<std::string> rig_settings = coarse;
    rig_settings.insert(rig_settings.end(), c.rig_settings.begin(), c.rig_settings.end());
    const Rehearsal r("papers/radar/single.yaml", "vortex.yaml", rig_settings, c.settings);
    SimulatedRig plant(r.scene.scenario, r.world, r.rig);
    const experiment::RunResult result = r.in_rig(plant);
    EXPECT_EQ(result.status, Status::fault) << c.fault;
    EXPECT_TRUE(plant.fault().starts_with(c.fault)) << plant.fault();
    // The coils stay at zero, whatever is commanded.
    const Vec2 at = plant.ground_truth()->swarm.pose.position;
    plant.apply({0, 1000}, 1);
    EXPECT_EQ(plant.ground_truth()->swarm.pose.position, at) << c.fault;
  }
}

TEST(SimulatedRig, ItAimsTheCoilsAtTheDetectedSwarm) {
  const Rehearsal r("papers/radar/single.yaml", "vortex.yaml", coarse);
  SimulatedRig plant(r.scene.scenario, r.world, r.rig);
  plant.observe();
  ASSERT_TRUE(plant.detections().swarm);
  const Vec2 seen = plant.detections().swarm->pose.position;
  const Vec2 truth = plant.ground_truth()->swarm.pose.position;
  plant.apply({0, 0}, 0.1);
  EXPECT_NE(seen, truth);
  EXPECT_EQ(plant.aim(), place_among_coils(r.rig.system, *r.world.map, seen));
}

TEST(SimulatedRig, TheSameSeedGivesTheSameRun) {
  Rehearsal r("papers/radar/single.yaml", "vortex.yaml", coarse);
  r.scene.scenario.time_limit = 8;
  SimulatedRig first(r.scene.scenario, r.world, r.rig);
  SimulatedRig second(r.scene.scenario, r.world, r.rig);
  r.in_rig(first);
  r.in_rig(second);
  EXPECT_EQ(first.picture().pixels, second.picture().pixels);
  EXPECT_EQ(first.ground_truth()->swarm.pose.position, second.ground_truth()->swarm.pose.position);
  SimulatedRig other(r.scene.scenario, r.world, r.rig, 1);
  r.in_rig(other);
  EXPECT_NE(first.picture().pixels, other.picture().pixels);
}

TEST(SimulatedRig, LimitsOfTheCoilsSlowItDown) {
  Rehearsal r("papers/radar/single.yaml", "vortex.yaml", coarse);
  r.scene.scenario.time_limit = 3;
  SimulatedRig free(r.scene.scenario, r.world, r.rig);
  r.in_rig(free);
  EXPECT_EQ(free.coils().scale, 1);
  actuation::CoilSystemParams weak;
  weak.coils = actuation::HelmholtzCoils{};
  weak.amplifiers = {actuation::AmplifierParams{.max_current = 0.01}};
  const Rig rig{r.rig.params, actuation::CoilSystem(weak)};
  SimulatedRig weakened(r.scene.scenario, r.world, rig);
  const Vec2 start = r.scene.scenario.start->position;
  r.in_rig(weakened);
  EXPECT_LT(weakened.coils().scale, 0.1);
  EXPECT_LT(distance(weakened.ground_truth()->swarm.pose.position, start),
            1);  // too weak to move it
}

TEST(SimulatedRig, WhatDoesNotGoTogetherIsRefused) {
  const auto refusal = [](const std::vector<std::string>& settings) {
    return test::error_of(
        [&] { Rehearsal("papers/radar/single.yaml", "vortex.yaml", settings).in_rig(); });
  };
  const auto ends_with = [](const std::string& text, std::string_view end) {
    return text.ends_with(end);
  };
  EXPECT_PRED2(ends_with, refusal({"drive_rate_hz=100"}),
               ": drive_rate_hz is 100, the field turns 16 times a second and needs at least 160");
  const auto on_device = [&](const std::string& rate, const std::string& frequency) {
    return test::error_of([&] {
      read_rig(scenarios / "rigs/vortex.yaml",
               {"driver.type=serial", "driver.waveforms=true", "drive_rate_hz=" + rate,
                "field.frequency_hz=" + frequency});
    });
  };
  EXPECT_EQ(on_device("50", "100"), "nothing was thrown");
  EXPECT_PRED2(ends_with, on_device("160", "16"),
               ": drive_rate_hz is 160, the line carries at most 100 waveforms a second");
  EXPECT_PRED2(ends_with, on_device("50", "501"),
               ": field.frequency_hz is 501, the device makes at most 500");
  EXPECT_PRED2(ends_with, refusal({"field.max_pitch_deg=1"}),
               "the swarm is meant to go 33.8 µm/s, this rig's field drives it at most 20 µm/s");
  EXPECT_PRED2(ends_with, refusal({"driver.type=simulated", "driver.channels=2"}),
               ": the system has 3 coils, the driver 2 channels");
  EXPECT_PRED2(ends_with, refusal({"camera.type=simulated", "camera.microscope.um_per_px=0.001"}),
               "pixels long, at most 4096 are drawn");
  EXPECT_PRED2(ends_with, refusal({"camera.type=v4l2"}),
               ": the camera is not simulated: set camera.type");
}

TEST(SimulatedRig, ANamedDeviceIsSimulatedLikeItAndNotOpened) {
  const Rehearsal r(
      "first_rig.yaml", "bench.yaml",
      {"camera.type=simulated", "camera.microscope.um_per_px=6", "driver.port=/dev/none"});
  const auto coils = simulated_coils(r.rig);
  EXPECT_EQ(coils->capabilities().channels, 6);
  EXPECT_EQ(coils->capabilities().input, actuation::CoilInput::waveform);
  EXPECT_EQ(coils->drive(std::vector<double>{10, 0, 0, 0, 0, 0}), actuation::DriveStatus::driven);
  EXPECT_EQ(coils->drive(std::vector<double>{10.1, 0, 0, 0, 0, 0}),
            actuation::DriveStatus::refused);
  EXPECT_EQ(r.in_rig().status, Status::solved);
}

TEST(SimulatedRig, AScenarioBeyondTheGridOfTheFieldIsRefused) {
  const test::Folder folder;
  std::string grid = "8\n2 2 2\n-0.0002 0.0002\n-0.0002 0.0002\n-0.0002 0.0002\n";
  for (int i = 0; i < 8; ++i)
    grid += fmt::format("{} {} {} 0.001 0 0\n", i & 4 ? 0.0002 : -0.0002, i & 2 ? 0.0002 : -0.0002,
                        i & 1 ? 0.0002 : -0.0002);
  for (const char* name : {"x.txt", "y.txt", "z.txt"}) folder.with(name, grid);
  folder.with("coils.yaml", "coils: {type: vfield, files: [x.txt, y.txt, z.txt]}\n");
  folder.with("rig.yaml", "coils: coils.yaml\nfield: {kind: rotating, max_pitch_deg: 7.5}\n");
  Rehearsal r("papers/radar/single.yaml", "vortex.yaml");
  const Rig rig = read_rig(folder / "rig.yaml");
  const std::string error = test::error_of([&] { SimulatedRig(r.scene.scenario, r.world, rig); });
  EXPECT_TRUE(
      error.ends_with("rig.yaml:1:8: the place (600, 500) µm of the scenario is at (-400, -400, 0) "
                      "µm among the coils, where their field is not known"))
      << error;
}

TEST(SimulatedRig, ASwarmMayBeFasterThanTheFieldIsMadeFor) {
  Rehearsal r("papers/radar/single.yaml", "vortex.yaml", coarse);
  r.scene.scenario.time_limit = 6;
  const auto way = [&](double error) {
    std::get<SimulatedCamera>(r.rig.params.camera).speed_error = error;
    SimulatedRig plant(r.scene.scenario, r.world, r.rig);
    const Vec2 from = plant.ground_truth()->swarm.pose.position;
    for (int i = 0; i < 60; ++i) plant.apply({1, 30}, 0.1);
    return distance(from, plant.ground_truth()->swarm.pose.position);
  };
  EXPECT_NEAR(way(1) / way(0), 2, 0.05);
  EXPECT_NEAR(way(-0.5) / way(0), 0.5, 0.05);
}

TEST(SimulatedRig, AFieldThatTurnsTooSlowlyIsNoted) {
  Rehearsal r("papers/global/two_robots.yaml", "rollers.yaml");
  EXPECT_EQ(unusual_field(r.rig, r.scene.scenario), "");
  r.rig.params.field.max_turn_rate = radians(360);
  EXPECT_EQ(unusual_field(r.rig, r.scene.scenario),
            "the rolling field takes 0.25 s to turn by 90°, a command lasts 0.1 s: robots lag "
            "behind at turns, see field.max_turn_rate_deg_per_s");
}

}  // namespace
}  // namespace microswarm::rig
