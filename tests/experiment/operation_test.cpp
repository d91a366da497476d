// SPDX-License-Identifier: Apache-2.0
// A run that a person operates: paused, steered by hand, held at the goal. A replay repeats it.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "microswarm/experiment/session/session.hpp"
#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

/// A run that is recorded tick by tick.
struct Operated {
  explicit Operated(const Scenario& scenario) : session(open_experiment(scenario, {})) {}
  void step(int ticks) {
    for (int i = 0; i < ticks; ++i) ASSERT_TRUE(session.step());
  }
  /// Steps until the goal is reached, a minute at most.
  void arrive() {
    const auto& events = session.record().events;
    for (int i = 0; i < 600; ++i) {
      if (std::ranges::count(events, EventKind::goal_reached, &RunEvent::kind) > 0) return;
      ASSERT_TRUE(session.step());
    }
    FAIL() << "not at the goal";
  }
  Record finish(const Stop& stop = {}) {
    session.finish(stop);
    return session.record();
  }
  Operation& operation() { return *session.operation(); }
  const Frame& newest() { return session.record().frames.back(); }

  Session session;
};

void expect_repeated(const Record& record) {
  const ReplayResult again = replay(record);
  EXPECT_TRUE(again.identical) << again.difference;
}

std::ptrdiff_t frames_in(const Record& record, NavigatorState state) {
  return std::ranges::count(record.frames, state, &Frame::state);
}

TEST(Operation, APauseHoldsTheSwarmAndTheTimeLimit) {
  Scenario scenario = small_flight();
  scenario.time_limit = 5;
  Operated run(scenario);
  run.step(20);
  run.operation().pause();
  run.step(100);
  EXPECT_EQ(run.newest().state, NavigatorState::paused);
  EXPECT_EQ(run.newest().command.speed, 0);
  EXPECT_LT(run.newest().speed, 1);
  run.operation().pause(false);
  const Record record = run.finish();
  EXPECT_EQ(record.result.status, Status::time_limit);
  EXPECT_EQ(frames_in(record, NavigatorState::paused), 100);
  // One clock: 5 s of the scenario and 10 s of the pause.
  EXPECT_NEAR(record.result.metrics.time, 15, 1e-6);
  EXPECT_EQ(record.frames.size(), 151u);
  expect_repeated(record);
}

TEST(Operation, APausedRunEndsByItsStop) {
  Operated run(small_flight());
  run.operation().pause();  // before the first tick
  run.step(50);
  const std::atomic<bool> stop = true;
  const Record record = run.finish(Stop(&stop));
  EXPECT_EQ(record.result.status, Status::stopped);
  EXPECT_NEAR(record.frames.back().pose.position.x, small_flight().start->position.x, 5);  // noise
  expect_repeated(record);
}

TEST(Operation, ByHandTheSwarmGoesWhereItIsSteeredWithinItsSpeed) {
  Operated run(open_room());
  run.step(5);
  run.operation().manual();
  const double y = run.newest().pose.position.y;
  for (int i = 0; i < 10; ++i) {
    run.operation().steer({std::numbers::pi / 2, 1e6});
    run.step(4);
  }
  EXPECT_EQ(run.newest().state, NavigatorState::manual);
  EXPECT_EQ(run.newest().command.speed, 60);
  EXPECT_GT(run.newest().pose.position.y, y + 100);
  run.operation().manual(false);
  const Record record = run.finish();
  EXPECT_EQ(frames_in(record, NavigatorState::manual), 40);
  EXPECT_EQ(record.result.status, Status::solved);
  expect_repeated(record);
}

TEST(Operation, WithoutKeysTheSwarmHoldsAfterHalfASecond) {
  Operated run(open_room());
  run.operation().manual();
  run.operation().steer({1, 20});
  run.step(5);
  EXPECT_EQ(run.newest().command.speed, 20);
  run.step(1);
  EXPECT_EQ(run.newest().command.speed, 0);
  EXPECT_EQ(run.newest().state, NavigatorState::manual);
  run.operation().steer({std::nan(""), 20});
  run.step(1);
  EXPECT_EQ(run.newest().command.speed, 0);
}

TEST(Operation, WhatWasSteeredInAPauseDoesNotCountAfterIt) {
  Operated run(open_room());
  run.operation().manual();
  run.operation().steer({1, 20});
  run.operation().pause();
  run.operation().steer({1, 30});
  run.step(2);
  EXPECT_EQ(run.newest().state, NavigatorState::paused);
  run.operation().pause(false);
  run.step(1);
  EXPECT_EQ(run.newest().state, NavigatorState::manual);
  EXPECT_EQ(run.newest().command.speed, 0);
}

TEST(Operation, AtTheGoalItIsHeldAndTheResultIsThatOfTheArrival) {
  Scenario scenario = small_flight();
  const Record plain = record_of(scenario);
  ASSERT_EQ(plain.result.status, Status::solved);
  scenario.hold_at_goal = 30;
  std::get<RibbonParams>(scenario.swarm).position_noise = 2;
  Operated run(scenario);
  const Record record = run.finish();
  EXPECT_EQ(record.result.status, Status::solved);
  EXPECT_NEAR(record.result.metrics.time, plain.result.metrics.time, 1e-9);
  EXPECT_NEAR(record.result.metrics.length, plain.result.metrics.length, 2);
  EXPECT_EQ(record.result.metrics.planning_events, plain.result.metrics.planning_events);
  EXPECT_LE(record.result.metrics.goal_distance, scenario.goal_tolerance);
  EXPECT_NEAR(record.frames.back().t, plain.frames.back().t + 30, 0.2);
  EXPECT_LE(record.frames.back().goal_distance, 1.2 * scenario.goal_tolerance);
  EXPECT_EQ(std::ranges::count(record.events, EventKind::goal_reached, &RunEvent::kind), 1);
  EXPECT_TRUE(std::ranges::is_sorted(record.events, {}, &RunEvent::t));
  EXPECT_EQ(record.result.timing.steps.size() + 1, record.frames.size());
  expect_repeated(record);
}

TEST(Operation, DrivenAwayFromTheGoalByHandItComesBack) {
  Scenario scenario = open_room();
  scenario.hold_at_goal = 60;
  Operated run(scenario);
  run.arrive();
  run.operation().manual();
  for (int i = 0; i < 50; ++i) {
    run.operation().steer({std::numbers::pi, 60});
    run.step(1);
  }
  EXPECT_GT(run.newest().goal_distance, 3 * scenario.goal_tolerance);
  run.operation().manual(false);
  const Record record = run.finish();
  EXPECT_EQ(record.result.status, Status::solved);
  EXPECT_LE(record.frames.back().goal_distance, 1.2 * scenario.goal_tolerance);
  expect_repeated(record);
}

TEST(Operation, EveryNavigatorHoldsAtTheGoalAndComesBack) {
  for (const navigation::NavigatorParams& navigator :
       {navigation::NavigatorParams{navigation::HierarchicalParams{}},
        navigation::NavigatorParams{navigation::RadarParams{}},
        navigation::NavigatorParams{navigation::StraightParams{}},
        navigation::NavigatorParams{navigation::PotentialFieldParams{}},
        navigation::NavigatorParams{navigation::VelocityObstacleParams{}},
        navigation::NavigatorParams{navigation::SafeIntervalParams{}}}) {
    Scenario scenario = open_room();
    scenario.navigator = navigator;
    scenario.goal = Vec2{500, 500};
    scenario.hold_at_goal = 40;
    SCOPED_TRACE(navigator.index());
    Operated run(scenario);
    run.arrive();
    for (int i = 0; i < 30; ++i) {
      run.step(1);
      EXPECT_LE(run.newest().goal_distance, 1.2 * scenario.goal_tolerance);
    }
    run.operation().manual();
    for (int i = 0; i < 50; ++i) {
      run.operation().steer({std::numbers::pi / 2, 60});
      run.step(1);
    }
    EXPECT_GT(run.newest().goal_distance, 2 * scenario.goal_tolerance);
    run.operation().manual(false);
    const Record record = run.finish();
    EXPECT_EQ(record.result.status, Status::solved);
    EXPECT_LE(record.frames.back().goal_distance, 1.2 * scenario.goal_tolerance);
    expect_repeated(record);
  }
}

TEST(Operation, AHoldThatIsEndedHasReachedTheGoal) {
  Scenario scenario = open_room();
  scenario.hold_at_goal = 1e6;
  Operated run(scenario);
  run.arrive();
  run.step(30);
  run.operation().end();
  const Record record = run.finish();
  EXPECT_EQ(record.result.status, Status::solved);
  expect_repeated(record);
}

TEST(Operation, AnEndBeforeTheGoalIsAStop) {
  Operated run(small_flight());
  run.step(7);
  run.operation().end();
  const Record record = run.finish();
  EXPECT_EQ(record.result.status, Status::stopped);
  expect_repeated(record);
}

TEST(Operation, AnotherGoalEndsTheHold) {
  Scenario scenario = open_room();
  scenario.hold_at_goal = 5;
  Operated run(scenario);
  const auto reached = [&] {
    return std::ranges::count(run.session.record().events, EventKind::goal_reached,
                              &RunEvent::kind);
  };
  run.arrive();
  run.step(10);
  EXPECT_TRUE(run.session.set("goal_um", "[1000, 500]").empty());
  const Record record = run.finish();
  EXPECT_EQ(reached(), 2);
  EXPECT_EQ(record.result.status, Status::solved);
  EXPECT_GT(record.result.metrics.length, 2000);
  expect_repeated(record);
}

}  // namespace
}  // namespace microswarm::experiment
