// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/plant/plant.hpp"

#include <gtest/gtest.h>

#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

Scenario delayed(double delay) {
  Scenario scenario = open_room();
  scenario.sensing.observation_delay = delay;
  std::get<RibbonParams>(scenario.swarm).response_lag = 0;
  scenario.obstacles = {disc(50, Straight{.start = {500, 700}, .velocity = {30, 0}})};
  return scenario;
}

TEST(KinematicPlant, ShowsSwarmAndObstaclesAsTheyWereOneDelayAgo) {
  for (const double delay : {0.0, 0.05, 0.1, 0.23}) {
    const Scenario scenario = delayed(delay);
    KinematicPlant plant(scenario, world_of(scenario));
    for (int i = 0; i < 20; ++i) plant.apply({0, 40}, 0.1);
    const Observation seen = plant.observe();
    EXPECT_NEAR(seen.now, 2, 1e-9);
    EXPECT_NEAR(seen.age(), delay, 1e-9);
    ASSERT_TRUE(seen.swarm);
    EXPECT_NEAR(seen.swarm->pose.position.x, 200 + 40 * (2 - delay), 1e-6);
    EXPECT_EQ(seen.swarm->radius, 40);
    const Body& body = seen.world->moving().bodies()[0];
    EXPECT_NEAR(std::get<Disc>(body.shape).centre.x, 500 + 30 * (2 - delay), 1e-6);
    EXPECT_NEAR(plant.ground_truth()->swarm.pose.position.x, 280, 1e-6);
  }
}

TEST(KinematicPlant, AtTheBeginningItShowsTheStart) {
  const Scenario scenario = delayed(0.05);
  KinematicPlant plant(scenario, world_of(scenario));
  const Observation seen = plant.observe();
  EXPECT_EQ(seen.seen, 0);
  EXPECT_EQ(seen.swarm->pose, *scenario.start);
}

TEST(KinematicPlant, DelaysLongerThanATickKeepTheirHistory) {
  Scenario scenario = delayed(1.05);
  std::get<RibbonParams>(scenario.swarm).max_turn_rate = 1;
  KinematicPlant plant(scenario, world_of(scenario));
  std::vector<Pose2> ground_truth{*scenario.start};
  for (int i = 0; i < 40; ++i) {
    plant.apply({0.1 * i, 40}, 0.1);
    ground_truth.push_back(plant.ground_truth()->swarm.pose);
    if (i < 12) continue;
    // 1.05 s ago lies half-way between two ticks, on a way that hardly bends.
    const Vec2 middle =
        0.5 * (ground_truth[i + 1 - 10].position + ground_truth[i + 1 - 11].position);
    EXPECT_LT(distance(plant.observe().swarm->pose.position, middle), 0.1);
  }
}

TEST(KinematicPlant, ObstaclesAreSeenWithTheNoiseAndTheMissesAskedFor) {
  Scenario scenario = delayed(0);
  scenario.obstacles.push_back(
      {Valve{.span = 400, .thickness = 40, .min_gap = 20, .max_gap = 200, .period = 8},
       Still{{800, 300}, 0.7}});
  scenario.sensing.obstacle_noise = 3;
  scenario.sensing.obstacle_missed_share = 0.2;
  const World world = world_of(scenario);
  KinematicPlant plant(scenario, world);
  int found = 0;
  double squares = 0;
  constexpr int frames = 3000;
  for (int k = 0; k < frames; ++k) {
    const Observation seen = plant.observe();
    ASSERT_TRUE(seen.swarm);  // which is seen all the same
    EXPECT_EQ(seen.swarm->pose, *scenario.start);
    const auto bodies = seen.world->moving().bodies();
    std::size_t leaves = 0;
    for (const Body& body : bodies) {
      leaves += body.obstacle == 1;
      if (body.obstacle != 0) continue;
      ++found;
      squares += squared_norm(std::get<Disc>(body.shape).centre - Vec2{500, 700});
    }
    EXPECT_TRUE(leaves == 0 || leaves == 2);
  }
  EXPECT_NEAR(found, 0.8 * frames, 100);
  EXPECT_NEAR(std::sqrt(0.5 * squares / found), 3, 0.15);
  EXPECT_EQ(std::get<Disc>(plant.ground_truth()->world->at(0).moving().bodies()[0].shape).centre,
            (Vec2{500, 700}));
}

TEST(KinematicPlant, NoiseAndMissedFramesAreThoseAskedFor) {
  Scenario scenario = delayed(0);
  scenario.sensing.position_noise = 5;
  scenario.sensing.missed_share = 0.25;
  KinematicPlant plant(scenario, world_of(scenario));
  double squares = 0;
  int found = 0;
  for (int i = 0; i < 4000; ++i) {
    const Observation seen = plant.observe();
    if (!seen.swarm) continue;
    ++found;
    squares += squared_norm(seen.swarm->pose.position - scenario.start->position);
  }
  EXPECT_NEAR(found / 4000.0, 0.75, 0.03);
  EXPECT_NEAR(std::sqrt(squares / found / 2), 5, 0.2);
}

TEST(KinematicPlant, AHiddenDelayMakesFramesOlderThanTheySay) {
  Scenario scenario = delayed(0.05);
  scenario.sensing.hidden_delay = 0.2;
  KinematicPlant plant(scenario, world_of(scenario));
  for (int i = 0; i < 20; ++i) plant.apply({0, 40}, 0.1);
  const Observation seen = plant.observe();
  EXPECT_NEAR(seen.age(), 0.05, 1e-9);
  EXPECT_EQ(seen.world->time(), seen.seen);
  EXPECT_NEAR(seen.swarm->pose.position.x, 200 + 40 * 1.75, 1e-6);
  const Body& body = seen.world->moving().bodies()[0];
  EXPECT_NEAR(std::get<Disc>(body.shape).centre.x, 500 + 30 * 1.75, 1e-6);
}

TEST(KinematicPlant, SightIsLostForTheTimeAskedForAndInTheShareAskedFor) {
  constexpr int frames = 20'000;
  constexpr double dt = 0.1;
  struct Sight {
    int missed = 0, bursts = 0;
    bool is_missed = false;
    void take(bool missing) {
      missed += missing;
      bursts += missing && !is_missed;
      is_missed = missing;
    }
  };
  for (const double share : {0.2, 0.8}) {
    Scenario scenario = delayed(0);
    scenario.sensing.missed_share = scenario.sensing.obstacle_missed_share = share;
    scenario.sensing.missed_time = share < 0.5 ? 0.7 : 0.1;
    KinematicPlant plant(scenario, world_of(scenario));
    Sight swarm, obstacle;
    for (int k = 0; k < frames; ++k) {
      const Observation seen = plant.observe();
      swarm.take(!seen.swarm);
      obstacle.take(seen.world->moving().empty());
      plant.apply({0, 0}, dt);
    }
    for (const Sight& sight : {swarm, obstacle}) {
      EXPECT_NEAR(1.0 * sight.missed / frames, share, 0.02);
      // A great share has longer bursts than asked for.
      if (share < 0.5) EXPECT_NEAR(dt * sight.missed / sight.bursts, 0.7, 0.07);
    }
  }
}

TEST(KinematicPlant, OnlyObstaclesThatAreNearAreMistakenInTheShareAskedFor) {
  Scenario scenario = delayed(0);
  scenario.obstacles = {disc(50, Still{{500, 700}, 0}), disc(50, Still{{500, 400}, 0}),
                        disc(60, Still{{500, 550}, 0}), disc(50, Still{{900, 100}, 0})};
  scenario.sensing.swapped_share = 0.3;
  KinematicPlant plant(scenario, world_of(scenario));
  constexpr int frames = 3000;
  int mistaken = 0;
  for (int k = 0; k < frames; ++k) {
    const Observation seen = plant.observe();
    const auto bodies = seen.world->moving().bodies();
    ASSERT_EQ(bodies.size(), 4u);
    for (std::uint32_t i = 0; i < 4; ++i) ASSERT_EQ(bodies[i].obstacle, i);
    EXPECT_EQ(std::get<Disc>(bodies[3].shape).centre, (Vec2{900, 100}));
    mistaken += std::get<Disc>(bodies[2].shape).radius != 60;
  }
  // The first two discs are not near each other: each mistake concerns the third.
  EXPECT_NEAR(1.0 * mistaken / frames, 0.3, 0.03);
}

TEST(KinematicPlant, TrialsDifferAndRepeat) {
  Scenario scenario = delayed(0);
  std::get<RibbonParams>(scenario.swarm).position_noise = 5;
  const auto end_of = [&](std::uint32_t trial) {
    KinematicPlant plant(scenario, world_of(scenario), trial);
    for (int i = 0; i < 10; ++i) plant.apply({0, 40}, 0.1);
    return plant.ground_truth()->swarm.pose;
  };
  EXPECT_EQ(end_of(3), end_of(3));
  EXPECT_NE(end_of(3), end_of(4));
}

}  // namespace
}  // namespace microswarm::experiment
