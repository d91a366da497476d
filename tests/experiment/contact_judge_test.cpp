// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/contact_judge.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "microswarm/scenes/avoidance_worlds.hpp"
#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

constexpr double radius = 40;
constexpr double speed = 80;
constexpr double dead_time = 0.15;  // response lag and observation delay [s]

Scenario vortex_room(std::vector<Obstacle> obstacles) {
  Scenario s = open_room();
  s.swarm = VortexParams{.radius = radius, .moving_radius = radius, .max_speed = speed};
  s.sensing.observation_delay = 0.05;
  s.obstacles = std::move(obstacles);
  s.stop_at_contact = false;
  s.time_limit = 30;
  s.hold_limit = 30;
  return s;
}

std::vector<ContactVerdict> judged(const Scenario& s, Navigator& navigator,
                                   const JudgeParams& params = {}) {
  const World world = world_of(s);
  KinematicPlant plant(s, world);
  ContactLog log;
  RunListener* const listeners[] = {&log};
  test::run(s, plant, navigator, listeners);
  return judge_contacts(s, world, 0, log, params);
}

Obstacle wall_that_moves(double x, double velocity) {
  return {BoxShape{100, 4000}, Straight{.start = {x, 500}, .velocity = {velocity, 0}}};
}

TEST(ContactJudge, OneThatDrivesIntoASwarmThatHoldsCouldHaveBeenLeft) {
  const Scenario s = vortex_room({disc(50, Straight{.start = {600, 500}, .velocity = {-40, 0}})});
  Steady hold({0, 0});
  const auto verdicts = judged(s, hold);
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_TRUE(verdicts[0].avoidable);
  EXPECT_TRUE(verdicts[0].manoeuvre.starts_with("retreat")) << verdicts[0].manoeuvre;
  EXPECT_LE(verdicts[0].decided, verdicts[0].contact.t - dead_time + 1e-9);
  EXPECT_GT(verdicts[0].decided, verdicts[0].contact.t - 0.5);
}

TEST(ContactJudge, OneThatTheSwarmDroveIntoCouldHaveBeenHeldOffFrom) {
  const Scenario s = vortex_room({disc(50, Still{{600, 500}, 0})});
  GoStraight straight(*s.goal, speed);
  const auto verdicts = judged(s, straight);
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_TRUE(verdicts[0].avoidable);
  EXPECT_EQ(verdicts[0].manoeuvre, "hold");
  EXPECT_LE(verdicts[0].decided, verdicts[0].contact.t - dead_time + 1e-9);
}

TEST(ContactJudge, WallsThatCloseFromBothSidesCannotBeAvoided) {
  const Scenario s = vortex_room({wall_that_moves(-300, 30), wall_that_moves(700, -30)});
  Steady hold({0, 0});
  const auto verdicts = judged(s, hold);
  ASSERT_EQ(verdicts.size(), 2u);
  for (const ContactVerdict& verdict : verdicts) {
    EXPECT_FALSE(verdict.avoidable);
    EXPECT_TRUE(verdict.manoeuvre.empty());
  }
}

TEST(ContactJudge, AWallFasterThanTheSwarmCannotBeAvoidedASlowerOneCan) {
  Steady hold({0, 0});
  const auto fast = judged(vortex_room({wall_that_moves(900, -2 * speed)}), hold);
  ASSERT_EQ(fast.size(), 1u);
  EXPECT_FALSE(fast[0].avoidable);
  // There is just room enough behind to run from a slow one until the judge looks away.
  Scenario s = vortex_room({wall_that_moves(1300, -0.5 * speed)});
  s.start = Pose2{{700, 500}, 0};
  const auto slow = judged(s, hold);
  ASSERT_EQ(slow.size(), 1u);
  EXPECT_TRUE(slow[0].avoidable);
}

TEST(ContactJudge, ADecisionLongAgoIsNoneOfTheJudges) {
  Steady hold({0, 0});
  // A broad wall that is faster can be stepped out of in time, but not in the last second.
  const Obstacle wall{BoxShape{50, 240},
                      Straight{.start = {1100, 500}, .velocity = {-2 * speed, 0}}};
  EXPECT_TRUE(judged(vortex_room({wall}), hold).at(0).avoidable);
  EXPECT_FALSE(judged(vortex_room({wall}), hold, {.lookback = 1}).at(0).avoidable);
}

TEST(ContactJudge, TheVerdictIsAboutTheSwarmAsItDrifted) {
  Scenario s = vortex_room({disc(50, Still{{600, 500}, 0})});
  std::get<VortexParams>(s.swarm).position_noise = 10;
  const World world = world_of(s);
  for (std::uint32_t trial = 0; trial < 10; ++trial) {
    KinematicPlant plant(s, world, trial);
    GoStraight straight({600, 500}, speed);
    ContactLog log;
    RunListener* const listeners[] = {&log};
    test::run(s, plant, straight, listeners);
    for (const ContactVerdict& verdict : judge_contacts(s, world, trial, log))
      EXPECT_LE(verdict.decided, verdict.contact.t);
  }
}

TEST(ContactJudge, SameRunSameVerdicts) {
  const Scenario s = scenes::avoidance_scenario(7, scenes::fast_obstacles);
  const auto once = [&] {
    const World world = scenes::avoidance_world(s);
    KinematicPlant plant(s, world);
    GoStraight straight(*s.goal, swarm_limits(s.swarm).max_speed);
    ContactLog log;
    RunListener* const listeners[] = {&log};
    test::run(s, plant, straight, listeners);
    return judge_contacts(s, world, 0, log);
  };
  const auto a = once();
  const auto b = once();
  ASSERT_FALSE(a.empty());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].contact.t, b[i].contact.t);
    EXPECT_EQ(a[i].avoidable, b[i].avoidable);
    EXPECT_EQ(a[i].decided, b[i].decided);
  }
}

}  // namespace
}  // namespace microswarm::experiment
