// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"
#include "tests/navigation/discs.hpp"

namespace microswarm::navigation {
namespace {

/// Obstacles as a camera sees them.
Snapshot frame_at(const std::vector<Obstacle>& obstacles, double t, double noise, Rng& rng) {
  static const auto map =
      std::make_shared<const Map>(Box{{-5000, -5000}, {5000, 5000}}, std::vector<Polygon>{});
  std::vector<Body> bodies;
  for (std::uint32_t i = 0; i < obstacles.size(); ++i) append_bodies(obstacles[i], i, t, bodies);
  for (Body& body : bodies) {
    const double dx = rng.normal(), dy = rng.normal();
    if (auto* disc = std::get_if<Disc>(&body.shape)) disc->centre += noise * Vec2{dx, dy};
  }
  return Snapshot(map, t, std::move(bodies));
}

struct Camera {
  std::vector<Obstacle> obstacles;
  double noise = 0;
  double delay = 0.05;
  double tick = 0.1;
  ObstacleTracker tracker{};
  Rng rng{3, Purpose::test};
  double now = 0;

  void watch(double seconds, double missed_share = 0) {
    for (const double end = now + seconds; now < end; now += tick) {
      if (rng.uniform() < missed_share) continue;
      const Snapshot world = frame_at(obstacles, now - delay, noise, rng);
      tracker.update(
          {.now = now, .seen = now - delay, .swarm = {}, .robots = {}, .world = borrowed(world)});
    }
  }
  TrackedBody body(std::size_t i = 0) const { return tracker.body(i); }
};

TEST(ObstacleTracker, RestsWhenSeenOnce) {
  Camera camera{.obstacles = {moving_disc(Straight{{10, 20}, {50, 0}})}};
  camera.watch(0.05);
  EXPECT_EQ(camera.body().velocity, Vec2{});
  EXPECT_EQ(camera.body().frames, 1);
  EXPECT_TRUE(std::isinf(camera.body().velocity_error));
}

TEST(ObstacleTracker, ConstantVelocityIsFoundExactly) {
  for (const double missed : {0.0, 0.5}) {
    Camera camera{.obstacles = {moving_disc(Straight{{10, 20}, {93, -41}}),
                                {BoxShape{200, 40}, Straight{{500, 500}, {-20, 70}}},
                                {PolygonShape{{{0, 0}, {100, 0}, {0, 60}}}, Straight{{}, {5, 5}}}}};
    camera.watch(3, missed);
    ASSERT_EQ(camera.tracker.size(), 3u);
    for (const auto& [i, v] : {std::pair{0, Vec2{93, -41}}, {1, Vec2{-20, 70}}, {2, Vec2{5, 5}}}) {
      EXPECT_LT(distance(camera.body(i).velocity, v), 1e-6);
      EXPECT_LT(norm(camera.body(i).acceleration), 1e-4);
      EXPECT_NEAR(camera.body(i).radius_rate, 0, 1e-6);
      EXPECT_NEAR(camera.body(i).outline_speed, 0, 1e-6);
    }
    EXPECT_NEAR(camera.body(0).radius, 60, 1e-9);
  }
}

TEST(ObstacleTracker, HarmonicVelocityWithinItsJerk) {
  const HarmonicLine motion{{500, 500}, {150, 80}, 12, 0};
  Camera camera{.obstacles = {moving_disc(motion)}};
  double worst = 0;
  for (int k = 0; k < 150; ++k) {
    camera.watch(0.1);
    if (k < 8) continue;
    const Placement truth = placement(motion, camera.tracker.seen());
    worst = std::max(worst, distance(camera.body().velocity, truth.velocity));
  }
  EXPECT_LT(worst, 0.025 * top_speed(motion));
}

TEST(ObstacleTracker, NoiseIsAveraged) {
  const Vec2 velocity{60, 30};
  const double noise = 4;
  double squares = 0;
  int count = 0;
  Camera camera{.obstacles = {moving_disc(Straight{{}, velocity})}, .noise = noise};
  camera.watch(2);
  for (; count < 400; ++count) {
    camera.watch(0.1);
    squares += squared_norm(camera.body().velocity - velocity);
  }
  const double of_two_frames = noise * std::sqrt(2.0) / camera.tick;
  EXPECT_LT(std::sqrt(squares / (2 * count)), 0.15 * of_two_frames);
}

TEST(ObstacleTracker, TheErrorItTellsIsTheErrorItMakes) {
  const Vec2 velocity{60, 30};
  Camera camera{.obstacles = {moving_disc(Straight{{}, velocity})}, .noise = 2};
  camera.watch(2);
  double squares = 0;
  double told = 0;
  for (int k = 0; k < 1000; ++k) {
    camera.watch(0.1);
    squares += 0.5 * squared_norm(camera.body().velocity - velocity);
    told += camera.body().velocity_error * camera.body().velocity_error;
  }
  EXPECT_GT(told, 0.4 * squares);
  EXPECT_LT(told, 2.5 * squares);
}

TEST(ObstacleTracker, ATurnIsNoticedWithinThreeFrames) {
  Camera camera{.obstacles = {moving_disc(Waypoints{{{0, 0}, {300, 0}}, 60, AtEnd::back})}};
  camera.watch(4.96);
  EXPECT_NEAR(camera.body().velocity.x, 60, 1e-6);
  camera.watch(0.36);  // turned round at 5 s, seen 0.05 s late
  EXPECT_NEAR(camera.body().velocity.x, -60, 1e-6);
}

TEST(ObstacleTracker, BreathingLeavesAndTurning) {
  Camera camera{.obstacles = {{BreathingDisc{40, 160, 10, 0}, Still{}},
                              {Valve{400, 40, 0, 300, 10, 0}, Still{}},
                              {BoxShape{200, 40}, HarmonicArc{{0, 0}, 500, 0, 0.5, 20, 0}}}};
  camera.watch(10.06);
  ASSERT_EQ(camera.tracker.size(), 4u);
  EXPECT_NEAR(camera.body(0).radius_rate, 60 * 2 * pi / 10, 1);
  EXPECT_LT(norm(camera.body(0).velocity), 1e-9);
  EXPECT_GT(camera.body(0).outline_speed, 30);
  EXPECT_NEAR(camera.body(1).velocity.y, -camera.body(2).velocity.y, 1e-6);  // the leaves part
  EXPECT_GT(camera.body(1).velocity.y, 10);
  const double turning = 0.5 * 2 * pi / 20;
  EXPECT_NEAR(camera.body(3).outline_speed, turning * std::hypot(100, 20), 1);
}

// A channel whose upper wall comes down at its right end only.
TEST(ObstacleTracker, APartThatMovesFarAwayDoesNotCountHere) {
  ObstacleTracker tracker;
  Body channel;
  const auto map = std::make_shared<const Map>(Box{{0, 0}, {3000, 1000}}, std::vector<Polygon>{});
  for (int k = 0; k < 20; ++k) {
    const double t = 0.1 * k;
    Polygon walls{.outer = {{0, 0}, {3000, 0}, {3000, 1000}, {0, 1000}}, .holes = {{}}};
    walls.holes[0] = {{100, 300},           {100, 700},  {900, 700}, {1800, 700},
                      {2400, 700 - 50 * t}, {2900, 700}, {2900, 300}};
    channel = {.shape = walls, .obstacle = 0};
    const Snapshot world(map, t, {channel});
    tracker.update({.now = t, .seen = t, .swarm = {}, .robots = {}, .world = borrowed(world)});
  }
  EXPECT_NEAR(tracker.body(0).outline_speed, 50, 3);
  EXPECT_NEAR(tracker.outline_speed_within(0, channel, {{2500, 500}, 200}), 50, 3);
  EXPECT_EQ(tracker.outline_speed_within(0, channel, {{500, 500}, 250}), 0);
  EXPECT_EQ(tracker.outline_speed_within(0, channel, {{500, 500}, 20}), 0) << "nothing is near";
}

// An outline of many vertices, drawn anew in every frame, beside the definition.
TEST(ObstacleTracker, OutlinesOfManyVerticesAreComparedExactly) {
  Rng rng(6, Purpose::test);
  const auto map = std::make_shared<const Map>(Box{{0, 0}, {3000, 1000}}, std::vector<Polygon>{});
  for (const int corners : {8, 200}) {
    ObstacleTrackerParams params;
    params.tuning.outline_spacing = 0;
    ObstacleTracker tracker(params);
    std::vector<Polygon> seen;
    for (int k = 0; k < 12; ++k) {
      Body body{.shape = Polygon{}, .obstacle = 0};
      auto& outer = std::get<Polygon>(body.shape).outer;
      const int count = k % 4 == 0 ? corners + 1 : corners;
      for (int i = 0; i < count; ++i)
        outer.push_back(Vec2{1000, 500} + rng.uniform(90, 110) * unit_vector(2 * pi * i / count));
      const Vec2 centre = enclosing_disc(body).centre;
      const Snapshot world(map, 0.1 * k, {body});
      tracker.update(
          {.now = 0.1 * k, .seen = 0.1 * k, .swarm = {}, .robots = {}, .world = borrowed(world)});
      if (k >= 2) {
        double most = 0;
        for (const Vec2 v : outer) most = std::max(most, distance(v - centre, seen[k - 2]));
        EXPECT_NEAR(tracker.body(0).outline_speed, most / 0.2, 1e-9);
      }
      for (Vec2& v : outer) v -= centre;
      seen.push_back(std::get<Polygon>(body.shape));
    }
  }
}

TEST(ObstacleTracker, ObstaclesComeAndGo) {
  Rng rng(1, Purpose::test);
  ObstacleTracker tracker;
  const auto see = [&](double t, const std::vector<Body>& bodies) {
    const Snapshot world(frame_at({}, t, 0, rng).shared_map(), t, bodies);
    tracker.update({.now = t, .seen = t, .swarm = {}, .robots = {}, .world = borrowed(world)});
  };
  const auto at = [](double x, std::uint32_t obstacle) {
    return Body{.shape = Disc{{x, 0}, 10}, .obstacle = obstacle};
  };
  see(0, {at(0, 4), at(100, 7)});
  see(0.1, {at(110, 7)});
  see(0.2, {at(40, 4), at(120, 7)});
  EXPECT_NEAR(tracker.body(0).velocity.x, 200, 1e-9);
  EXPECT_NEAR(tracker.body(1).velocity.x, 100, 1e-9);
  see(0.2, {at(0, 4), at(0, 7)});  // the same frame again
  EXPECT_NEAR(tracker.body(1).velocity.x, 100, 1e-9);
  see(5, {at(900, 4)});  // forgotten meanwhile
  ASSERT_EQ(tracker.size(), 1u);
  EXPECT_EQ(tracker.body(0).velocity, Vec2{});
  see(0.1, {at(900, 4)});  // begun anew
  EXPECT_EQ(tracker.body(0).frames, 1);
  tracker.update({});
  EXPECT_EQ(tracker.size(), 1u);
}

TEST(ObstacleTracker, TheNoiseAssumedAtFirstAndAtLeastIsTuned) {
  ObstacleTrackerParams params;
  params.tuning.fit.initial_noise = 1.25;
  params.tuning.fit.min_noise = 0.75;
  Camera camera{.obstacles = {moving_disc(Straight{{}, {60, 30}})},
                .tracker = ObstacleTracker(params)};
  camera.watch(0.35);
  EXPECT_EQ(camera.body().noise, 1.25);
  camera.watch(2);
  EXPECT_EQ(camera.body().noise, 0.75);
}

TEST(ObstacleTracker, TheNumberOfSightingsForTheNoiseIsTuned) {
  ObstacleTrackerParams params;
  params.tuning.fit.min_noise_sightings = 4;
  const std::vector<Obstacle> obstacles{moving_disc(Straight{{}, {60, 30}})};
  Camera usual{.obstacles = obstacles};
  Camera early{.obstacles = obstacles, .tracker = ObstacleTracker(params)};
  usual.watch(0.45);
  early.watch(0.45);
  EXPECT_EQ(usual.body().noise, MotionFitTuning{}.initial_noise);
  EXPECT_EQ(early.body().noise, MotionFitTuning{}.min_noise);
}

TEST(ObstacleTracker, ATurnIsNoticedLateWhenLargeResidualsAreAllowed) {
  ObstacleTrackerParams params;
  params.tuning.fit.max_residual = 100'000;
  Camera camera{.obstacles = {moving_disc(Waypoints{{{0, 0}, {300, 0}}, 60, AtEnd::back})},
                .tracker = ObstacleTracker(params)};
  camera.watch(5.32);  // turned round at 5 s
  EXPECT_GT(camera.body().velocity.x, -50);
}

TEST(ObstacleTracker, FramesForTheNoiseAreTuned) {
  ObstacleTrackerParams params;
  params.tuning.noise_windows = 1;
  params.memory = 10;
  const auto noise_after_a_calm = [](const ObstacleTrackerParams& p) {
    Camera camera{.obstacles = {moving_disc(Straight{{}, {60, 30}})},
                  .noise = 5,
                  .tracker = ObstacleTracker(p)};
    camera.watch(3);
    camera.noise = 0;
    camera.watch(1.6);
    return camera.body().noise;
  };
  EXPECT_EQ(noise_after_a_calm(params), MotionFitTuning{}.min_noise);
  params.tuning.noise_windows = 4;
  EXPECT_GT(noise_after_a_calm(params), 1);
}

TEST(ObstacleTracker, OutlinesAreComparedOverATunedTime) {
  ObstacleTrackerParams params;
  params.tuning.outline_spacing = 60;
  const std::vector<Obstacle> obstacles{
      {BoxShape{200, 40}, HarmonicArc{{0, 0}, 260, 0.4, 1.1, 9, 0.3}}};
  Camera usual{.obstacles = obstacles};
  Camera slow{.obstacles = obstacles, .tracker = ObstacleTracker(params)};
  usual.watch(5);
  slow.watch(5);
  EXPECT_NE(usual.body().outline_speed, slow.body().outline_speed);
}

}  // namespace
}  // namespace microswarm::navigation
