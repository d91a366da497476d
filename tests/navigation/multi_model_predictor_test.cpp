// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"
#include "tests/navigation/discs.hpp"

namespace microswarm::navigation {
namespace {

/// A camera's frames of some obstacles: what only a simulation knows of them is wrong in these.
struct Watched {
  std::vector<Obstacle> obstacles;
  double noise = 0;
  MultiModelPredictor prediction{};
  Rng rng{5, Purpose::test};
  double now = 0;
  int frames = 0;

  void watch(double seconds) {
    static const auto map =
        std::make_shared<const Map>(Box{{-5000, -5000}, {5000, 5000}}, std::vector<Polygon>{});
    const int more = static_cast<int>(std::lround(seconds / 0.1));
    for (int k = 0; k < more; ++k, ++frames) {
      now = 0.1 * frames;
      std::vector<Body> bodies;
      for (std::uint32_t i = 0; i < obstacles.size(); ++i)
        append_bodies(obstacles[i], i, now, bodies);
      for (Body& body : bodies) {
        const double dx = rng.normal(), dy = rng.normal();
        if (auto* disc = std::get_if<Disc>(&body.shape)) disc->centre += noise * Vec2{dx, dy};
      }
      const Snapshot frame(map, now, std::move(bodies));
      prediction.update(
          {.now = now, .seen = now, .swarm = {}, .robots = {}, .world = borrowed(frame)});
    }
  }
  /// How far off the forecast of an obstacle's centre is [µm].
  double error(double ahead, std::size_t i = 0) const {
    return distance(prediction.at(i, now + ahead).centre,
                    placement(obstacles[i].motion, now + ahead).pose.position);
  }
};

TEST(MultiModelPredictor, GoesStraightOnWithWhatGoesStraight) {
  Watched w{.obstacles = {moving_disc(Straight{{-100, 50}, {170, -60}})}};
  w.watch(1);
  EXPECT_LT(w.error(6), 1e-6);
  w.watch(5);
  EXPECT_LT(w.error(6), 1e-6);
}

TEST(MultiModelPredictor, LearnsASwingOnALine) {
  Watched w{.obstacles = {moving_disc(HarmonicLine{{0, 0}, {250, 100}, 11, 0.1})}};
  w.watch(6);
  for (int k = 0; k < 100; ++k) {
    w.watch(0.1);
    EXPECT_LT(w.error(3), 15) << w.now;
  }
  EXPECT_GE(w.prediction.model(0), MotionModels::swing);
}

TEST(MultiModelPredictor, LearnsASwingOnAnArcAndTurnsWithIt) {
  const HarmonicArc motion{{0, 0}, 260, 0.4, 1.1, 9, 0.3};
  Watched w{.obstacles = {{BoxShape{150, 40}, motion}}};
  w.watch(12);
  for (int k = 0; k < 60; ++k) {
    w.watch(0.1);
    EXPECT_LT(w.error(3), 15) << w.now;
    const double turned =
        placement(motion, w.now + 2).pose.heading - placement(motion, w.now).pose.heading;
    EXPECT_NEAR(w.prediction.at(0, w.now + 2).turn, turned, 0.1);
  }
}

TEST(MultiModelPredictor, RemembersTheCornersOfARound) {
  const Waypoints round{{{0, 0}, {400, 0}, {400, 300}}, 150, AtEnd::loop};
  Watched w{.obstacles = {moving_disc(round)}};
  w.watch(12);  // a round takes 8 s
  int good = 0;
  for (int k = 0; k < 80; ++k) {
    w.watch(0.1);
    good += w.error(2) < 30;
  }
  EXPECT_GE(good, 70);
}

TEST(MultiModelPredictor, ExpectsTheWayBackOfWhatTurnsBack) {
  const Waypoints there_and_back{{{0, 0}, {500, 0}, {500, 400}}, 160, AtEnd::back};
  Watched w{.obstacles = {moving_disc(there_and_back)}};
  w.watch(6.5);  // it turns at 5.6 s, and meets the old corner, back, at 8.1 s
  EXPECT_LT(w.error(2.5), 30);
}

TEST(MultiModelPredictor, BreathingIsForeseen) {
  const BreathingDisc breath{40, 90, 8, 0};
  Watched w{.obstacles = {{breath, Still{{0, 0}, 0}}}};
  w.watch(10);
  for (int k = 0; k < 40; ++k) {
    w.watch(0.1);
    const auto radius = [&](double t) {
      std::vector<Body> bodies;
      append_bodies(w.obstacles[0], 0, t, bodies);
      return std::get<Disc>(bodies[0].shape).radius;
    };
    EXPECT_NEAR(w.prediction.at(0, w.now + 2).growth, radius(w.now + 2) - radius(w.now), 8);
  }
}

TEST(MultiModelPredictor, NoiseDoesNotUpsetIt) {
  Watched w{.obstacles = {moving_disc(Straight{{-900, 50}, {170, -60}}),
                          moving_disc(HarmonicLine{{0, 0}, {250, 100}, 11, 0.1}),
                          moving_disc(HarmonicArc{{0, 0}, 260, 0.4, 1.1, 9, 0.3})},
            .noise = 1.5};
  w.watch(10);
  std::array<double, 3> sum{};
  for (int k = 0; k < 80; ++k) {
    w.watch(0.1);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w.error(2, i) / 80;
  }
  EXPECT_LT(sum[0], 15);
  EXPECT_LT(sum[1], 30);
  EXPECT_LT(sum[2], 40);
}

TEST(MultiModelPredictor, WhatVanishesIsForgotten) {
  Watched w{
      .obstacles = {moving_disc(Straight{{0, 0}, {100, 0}}), moving_disc(Still{{900, 900}, 0})}};
  w.watch(3);
  w.obstacles.pop_back();
  w.watch(3);
  EXPECT_EQ(w.prediction.size(), 1u);
  EXPECT_LT(w.error(2), 1e-6);
}

/// How often one of the models from `first` up to `end` is selected while the obstacle moves.
int selections(const Motion& motion, const MultiModelPredictorTuning& tuning, std::size_t first,
               std::size_t end) {
  MultiModelPredictorParams params;
  params.tuning = tuning;
  Watched w{.obstacles = {moving_disc(motion)}, .prediction = MultiModelPredictor(params)};
  int count = 0;
  for (int k = 0; k < 180; ++k) {
    w.watch(0.1);
    count += w.prediction.model(0) >= first && w.prediction.model(0) < end;
  }
  return count;
}

TEST(MultiModelPredictor, CirclesBeyondTheTunedRadiusAreNoCircles) {
  const HarmonicArc motion{{0, 0}, 260, 0.4, 1.1, 9, 0.3};
  MultiModelPredictorTuning tuning;
  EXPECT_GT(selections(motion, tuning, MotionModels::arc, MotionModels::again), 20);
  tuning.models.max_circle_radius = 200;
  EXPECT_EQ(selections(motion, tuning, MotionModels::arc, MotionModels::again), 0);
}

TEST(MultiModelPredictor, ABodySlowerThanTheTunedSpeedNeverRecurs) {
  const Waypoints round{{{0, 0}, {400, 0}, {400, 300}}, 150, AtEnd::loop};
  MultiModelPredictorTuning tuning;
  EXPECT_GT(selections(round, tuning, MotionModels::again, MotionModels::count), 20);
  tuning.recurrence.min_speed = 200;
  EXPECT_EQ(selections(round, tuning, MotionModels::again, MotionModels::count), 0);
}

TEST(MultiModelPredictor, OscillationsAreFoundAmongTunedFrequenciesAndWindows) {
  const HarmonicLine motion{{0, 0}, {250, 100}, 11, 0.1};
  MultiModelPredictorTuning tuning;
  const int usual = selections(motion, tuning, MotionModels::swing, MotionModels::again);
  EXPECT_GT(usual, 20);
  tuning.oscillation.min_sightings = 1000;
  EXPECT_EQ(selections(motion, tuning, MotionModels::swing, MotionModels::again), 0);
  tuning = {};
  tuning.oscillation.min_frequency = 2;
  EXPECT_LT(selections(motion, tuning, MotionModels::swing, MotionModels::again), usual);
  tuning = {};
  tuning.oscillation.short_window = 0.1;
  tuning.oscillation.medium_window = 0.2;
  tuning.oscillation.long_window = 0.3;
  EXPECT_EQ(selections(motion, tuning, MotionModels::swing, MotionModels::again), 0);
}

// Leaves that are not seen while they are retracted.
TEST(MultiModelPredictor, ExpectsBackWhatShrankAway) {
  const Valve valve{
      .span = 200, .thickness = 30, .min_gap = 0, .max_gap = 300, .period = 10, .phase = 0};
  Watched w{.obstacles = {{valve, Still{{0, 0}, 0}}, moving_disc(Straight{{-100, 900}, {60, 0}})}};
  w.watch(3);
  while (w.prediction.size() == 3) w.watch(0.1);
  while (w.prediction.size() == 1) w.watch(0.1);
  w.watch(3);
  while (w.prediction.size() == 3) w.watch(0.1);
  ASSERT_EQ(w.prediction.hidden(), 2u);
  const double gone = w.now;
  double back = gone;
  for (std::vector<Body> bodies; bodies.empty(); back += 0.1)
    append_bodies(w.obstacles[0], 0, back, bodies);
  ASSERT_GT(back - gone, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(w.prediction.hidden_at(i, gone + 0.5).radius, 0);
    EXPECT_EQ(w.prediction.hidden_at(i, back - 1).radius, 0);
    const Disc leaf = w.prediction.hidden_at(i, back + 1);
    std::vector<Body> bodies;
    append_bodies(w.obstacles[0], 0, back + 1, bodies);
    EXPECT_NEAR(distance(leaf.centre, enclosing_disc(bodies.at(i)).centre), 0, 12);
    EXPECT_GT(leaf.radius, 15);
  }
  w.watch(back - gone + 0.1);
  EXPECT_EQ(w.prediction.hidden(), 0u);
}

}  // namespace
}  // namespace microswarm::navigation
