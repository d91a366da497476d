// SPDX-License-Identifier: Apache-2.0
#include "tests/runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "microswarm/experiment/scenario/experiment.hpp"
#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

/// A run by a given navigator, with what it told.
struct Told : RunListener {
  std::vector<Frame> frames;
  std::vector<RunEvent> events;
  RunResult result;

  void on_tick(const Tick& tick) override {
    frames.push_back(tick.frame);
    events.insert(events.end(), tick.events.begin(), tick.events.end());
  }
};

Told run_with(const Scenario& scenario, Navigator& navigator, const Stop& stop = {}) {
  Told told;
  KinematicPlant plant(scenario, world_of(scenario));
  RunListener* const listeners[] = {&told};
  told.result = test::run(scenario, plant, navigator, listeners, stop);
  return told;
}

TEST(Run, StraightToTheGoal) {
  const Scenario scenario = open_room();
  GoStraight navigator(*scenario.goal, 60);
  const Told told = run_with(scenario, navigator);
  const Metrics& m = told.result.metrics;
  EXPECT_EQ(told.result.status, Status::solved);
  // 1600 µm less the tolerance of 50, at 60 µm/s after a lag of 0.1 s.
  EXPECT_NEAR(m.length, 1550, 1e-6);
  EXPECT_NEAR(m.time, 0.1 + 1550 / 60.0, 1e-6);
  EXPECT_NEAR(m.turning, 0, 1e-9);
  EXPECT_NEAR(m.goal_distance, 50, 1e-6);
  EXPECT_NEAR(m.walls.clearance, 200, 1e-9);
  EXPECT_EQ(m.obstacles.clearance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(m.contacts, 0);
  EXPECT_EQ(told.frames.back().state, NavigatorState::end);
  EXPECT_EQ(told.frames.back().t, m.time);
  EXPECT_EQ(told.frames.size(), told.result.timing.steps.size() + 1);
  ASSERT_EQ(told.events.size(), 1u);
  EXPECT_EQ(told.events[0].kind, EventKind::goal_reached);
}

// Whatever it faces in a narrow channel, it rather holds.
TEST(Run, ASwarmThatTurnsSlowlyTouchesNoWall) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {
      {{0, 0}, {2000, 0}, {2000, 430}, {0, 430}}, {{0, 570}, {2000, 570}, {2000, 1000}, {0, 1000}}};
  RibbonParams swarm{.radius = 40, .max_speed = 80};
  scenario.goal_tolerance = 5;
  scenario.hold_limit = 2;
  navigation::HierarchicalParams drrt;
  drrt.clearance = 40;
  const navigation::SafeIntervalParams safe_interval;
  Rng rng(3, Purpose::scene, 0);
  for (int trial = 0; trial < 24; ++trial) {
    swarm.max_turn_rate = radians(trial % 2 == 0 ? 20 : 60);
    scenario.swarm = swarm;
    scenario.start = Pose2{{rng.uniform(300, 1700), rng.uniform(475, 525)}, rng.uniform(-pi, pi)};
    scenario.goal = Vec2{scenario.start->position.x + rng.uniform(-150, 150),
                         rng.uniform(0, 1) < 0.5 ? 466.0 : 534.0};
    for (const navigation::NavigatorParams& navigator :
         {navigation::NavigatorParams{drrt}, navigation::NavigatorParams{safe_interval}}) {
      scenario.navigator = navigator;
      const RunResult result = simulate(scenario, world_of(scenario));
      EXPECT_NE(result.status, Status::collided)
          << trial << ", navigator " << navigator.index() << ", " << result.metrics.time;
    }
  }
}

// Waiting for an obstacle to pass must not look better again and again.
TEST(Run, AWaitForAnObstacleEnds) {
  const auto file = std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios/first_flight.yaml";
  for (int commanded = 20; commanded <= 80; commanded += 5) {
    const Experiment flight =
        open_experiment(file, {fmt::format("navigator.speed_um_per_s={}", commanded)});
    const RunResult result = simulate(flight.scenario(), flight.world);
    EXPECT_EQ(result.status, Status::solved) << commanded;
    EXPECT_LT(result.metrics.hold_time, 30) << commanded;
  }
}

TEST(Run, AlreadyThere) {
  Scenario scenario = open_room();
  scenario.goal = Vec2{210, 500};
  GoStraight navigator(*scenario.goal, 60);
  const Told told = run_with(scenario, navigator);
  EXPECT_EQ(told.result.status, Status::solved);
  EXPECT_EQ(told.result.metrics.time, 0);
}

TEST(Run, EndsAtTheTouchOfAWall) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {
      {{1000, 0}, {1001, 0}, {1001, 1000}, {1000, 1000}}};
  GoStraight navigator(*scenario.goal, 60);
  const Told told = run_with(scenario, navigator);
  EXPECT_EQ(told.result.status, Status::collided);
  EXPECT_NEAR(told.frames.back().pose.position.x, 960, 60 * ribbon_substep + 1e-9);
  EXPECT_EQ(told.result.metrics.contacts, 1);
  EXPECT_EQ(told.result.metrics.avoidable_contacts, 1);
}

TEST(Run, CountsTouchesAndGoesOnWhenToldTo) {
  Scenario scenario = open_room();
  scenario.stop_at_contact = false;
  scenario.obstacles = {disc(30, Still{{1000, 500}, 0}), disc(30, Still{{1400, 500}, 0})};
  GoStraight navigator(*scenario.goal, 60);
  const Told told = run_with(scenario, navigator);
  EXPECT_EQ(told.result.status, Status::collided);  // though it arrived
  EXPECT_LT(told.result.metrics.goal_distance, scenario.goal_tolerance + 1e-6);
  EXPECT_EQ(told.result.metrics.contacts, 2);
  EXPECT_EQ(told.result.metrics.obstacles.clearance, 0);
}

TEST(Run, ATouchIsToldHoweverTheRunEnds) {
  Scenario scenario = open_room();
  scenario.stop_at_contact = false;
  scenario.time_limit = 20;
  scenario.obstacles = {disc(30, Straight{.start = {600, 500}, .velocity = {-50, 0}})};
  Steady navigator({0, 0});
  const Told told = run_with(scenario, navigator);
  EXPECT_EQ(told.result.status, Status::collided);
  EXPECT_NEAR(told.result.metrics.time, 20, 1e-9);
}

TEST(Run, NothingThatComesAfterTheLastTouchCounts) {
  Scenario scenario = open_room();
  scenario.tick = 10;  // the touch is in the middle of a tick
  scenario.obstacles = {disc(30, Straight{.start = {600, 500}, .velocity = {-50, 0}})};
  Steady navigator({0, 0});
  const Told told = run_with(scenario, navigator);
  EXPECT_EQ(told.result.status, Status::collided);
  EXPECT_NEAR(told.result.metrics.obstacles.clearance,
              std::get<RibbonParams>(scenario.swarm).radius, 0.1);
}

TEST(Run, ATouchWhileHoldingIsNotTheSwarmsFault) {
  Scenario scenario = open_room();
  scenario.obstacles = {disc(30, Straight{.start = {600, 500}, .velocity = {-50, 0}})};
  Steady navigator({0, 0});
  const Told told = run_with(scenario, navigator);
  EXPECT_EQ(told.result.status, Status::collided);
  EXPECT_EQ(told.result.metrics.contacts, 1);
  EXPECT_EQ(told.result.metrics.avoidable_contacts, 0);
  EXPECT_NEAR(told.result.metrics.time, (400 - 70) / 50.0, 1e-3);
}

TEST(Run, HoldingTooLongEndsIt) {
  Scenario scenario = open_room();
  scenario.hold_limit = 5;
  Steady hold({0, 0});
  Told told = run_with(scenario, hold);
  EXPECT_EQ(told.result.status, Status::held);
  EXPECT_NEAR(told.result.metrics.time, 4.9, 1e-9);
  EXPECT_EQ(told.events[0].kind, EventKind::hold_begins);

  scenario.hold_limit = 1000;
  told = run_with(scenario, hold);
  EXPECT_EQ(told.result.status, Status::held);
  EXPECT_NEAR(told.result.metrics.time, scenario.time_limit, 1e-6);
  EXPECT_NEAR(told.result.metrics.hold_time, scenario.time_limit, 1e-6);
}

TEST(Run, TheTimeLimitEndsIt) {
  Scenario scenario = open_room();
  scenario.time_limit = 3;
  GoStraight navigator(*scenario.goal, 60);
  const Told told = run_with(scenario, navigator);
  EXPECT_EQ(told.result.status, Status::time_limit);
  EXPECT_EQ(told.frames.size(), 31u);
  EXPECT_NEAR(told.frames.back().t, 3, 1e-9);
}

TEST(Run, StopsWhenToldAndKeepsWhatWas) {
  const Scenario scenario = open_room();
  struct StopAt : GoStraight {
    using GoStraight::GoStraight;
    std::atomic<bool> flag{false};
    int steps = 0;
    Command step(const Observation& seen, const Stop& stop) override {
      if (++steps == 8) flag = true;
      return GoStraight::step(seen, stop);
    }
  } navigator(*scenario.goal, 60);
  const Told told = run_with(scenario, navigator, Stop(&navigator.flag));
  EXPECT_EQ(told.result.status, Status::stopped);
  EXPECT_EQ(told.frames.size(), 8u);  // seven whole ticks and the end
  EXPECT_NEAR(told.result.metrics.time, 0.7, 1e-9);
}

TEST(Run, WithoutTheTruthWhatIsSeenCounts) {
  struct Blind : KinematicPlant {
    using KinematicPlant::KinematicPlant;
    std::optional<GroundTruth> ground_truth() const override { return std::nullopt; }
  };
  const Scenario scenario = open_room();
  Blind plant(scenario, world_of(scenario));
  GoStraight navigator(*scenario.goal, 60);
  const RunResult result = test::run(scenario, plant, navigator);
  EXPECT_EQ(result.status, Status::solved);
  EXPECT_NEAR(result.metrics.length, 1550, 6);
  EXPECT_NEAR(result.metrics.walls.clearance, 200, 1e-9);
}

TEST(TimeSummary, OfKnownNumbers) {
  const std::vector<double> times{4, 1, 3, 2, 5};
  const TimeSummary s = summarise(times);
  EXPECT_EQ(s.count, 5);
  EXPECT_EQ(s.mean, 3);
  EXPECT_NEAR(s.sd, std::sqrt(2.5), 1e-12);
  EXPECT_EQ(s.p50, 3);
  EXPECT_EQ(s.p99, 5);
  EXPECT_EQ(s.max, 5);
  EXPECT_EQ(summarise({}).count, 0);
}

TEST(AvoidanceCost, IsEquationFour) {
  // The examples given with Fig 1 [radar]: 100 of 200 px left at 60°, 130 left at 90°.
  EXPECT_NEAR(avoidance_cost({100, 0}, 100, pi / 3, true, 200), 0.25, 1e-12);
  EXPECT_NEAR(avoidance_cost({0, 130}, 130, 0, true, 200), 0.65, 1e-12);
  EXPECT_EQ(avoidance_cost({100, 0}, 100, 0, true, 200), 0);
  EXPECT_EQ(avoidance_cost({-100, 0}, 100, 0, true, 200), 1);
  EXPECT_EQ(avoidance_cost({100, 0}, 100, 0, false, 200), 0.5);  // a hold gets no nearer
  EXPECT_EQ(avoidance_cost({0, 0}, 100, 1, true, 200), 0);
  // Towards a phased goal l is still what is left to the goal.
  EXPECT_EQ(avoidance_cost({10, 0}, 100, 0, true, 200), 0);
  EXPECT_NEAR(avoidance_cost({0, 10}, 100, 0, true, 200), 0.5, 1e-12);
}

TEST(Run, TheCostIsMeasuredTowardsThePhasedGoal) {
  // Up to a waypoint at right angles to the goal, beside an obstacle that does not matter.
  struct Upwards : GoStraight {
    using GoStraight::GoStraight;
    Vec2 waypoint{200, 900};
    bool tells = false;
    Command step(const Observation&, const Stop&) override { return {0.5 * pi, 60}; }
    NavigatorView view() const override {
      NavigatorView view = GoStraight::view();
      if (tells) view.phased_goal = waypoint;
      return view;
    }
  };
  Scenario scenario = open_room();
  scenario.swarm = VortexParams{.radius = 40, .moving_radius = 40, .radius_ripple = 0};
  scenario.time_limit = 3;
  scenario.detection_range = 300;
  scenario.obstacles = {disc(50, Still{{400, 600}, 0})};
  for (const bool tells : {false, true}) {
    Upwards navigator(*scenario.goal, 60);
    navigator.tells = tells;
    const Metrics m = run_with(scenario, navigator).result.metrics;
    EXPECT_NEAR(m.avoidance.time, 3, 1e-9);
    if (tells)
      EXPECT_LT(m.avoidance.mean_cost, 0.1);  // it stands still for the lag
    else
      EXPECT_GT(m.avoidance.mean_cost, 0.9);
  }
}

TEST(Run, CountsWhatItAvoidsOnlyWhileSomethingIsNear) {
  Scenario scenario = open_room();
  scenario.detection_range = 100;
  scenario.obstacles = {disc(50, Still{{1000, 800}, 0})};
  GoStraight navigator(*scenario.goal, 60);
  const Told far = run_with(scenario, navigator);
  EXPECT_EQ(far.result.metrics.avoidance.time, 0);
  EXPECT_EQ(far.result.metrics.avoidance.mean_cost, 0);
  EXPECT_GT(far.result.metrics.avoidance.min_gap, 100);
  scenario.detection_range = 400;
  const Told near = run_with(scenario, navigator);
  EXPECT_GT(near.result.metrics.avoidance.time, 1);
  EXPECT_GE(near.result.metrics.avoidance.mean_gap, near.result.metrics.avoidance.min_gap);
  EXPECT_NEAR(near.result.metrics.avoidance.min_gap, far.result.metrics.avoidance.min_gap, 1e-9);
}

}  // namespace
}  // namespace microswarm::experiment
