// SPDX-License-Identifier: Apache-2.0
// One swarm in the pictures of a rig: found, followed, or not taken for something else.
#include "microswarm/rig/perception/swarm_perception.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/radar/wait_zone.hpp"
#include "microswarm/rig/simulation/microscope.hpp"
#include "microswarm/rig/watch/follow_monitor.hpp"
#include "tests/rig/perceived.hpp"

namespace microswarm::rig {
namespace {

using test::channel;
using test::eye_params;
using test::session_view;

TEST(SwarmPerception, FollowsASwarmAmongObstacles) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 2;
  Microscope microscope(optics, *map, 1, 0);
  SwarmPerception perception(eye_params(), {.max_speed = 100}, *map, {{200, 300}, 0},
                             session_view(microscope));
  std::uint32_t standing_number = 0;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.1 * i;
    const Vec2 position{200 + 80 * t, 300 + 40 * t};
    const SwarmPose swarm{{position, 0}, 40};
    // One goes along with it, 8 µm from edge to edge; one stands.
    const Snapshot world(map, t,
                         {{.shape = Disc{position + Vec2{0, 108}, 60}, .obstacle = 0},
                          {.shape = Disc{{900, 250}, 50}, .obstacle = 1}});
    const Detections& seen = perception.process(microscope.look(world, swarm, {}), t);
    ASSERT_TRUE(seen.swarm) << t;
    EXPECT_LT(distance(seen.swarm->pose.position, position), 3) << t;
    EXPECT_NEAR(seen.swarm->radius, 40, 4);
    if (i > 5) {
      EXPECT_LT(turn_between(seen.swarm->pose.heading, std::atan2(1, 2)), 0.15);
    }
    ASSERT_EQ(seen.moving.size(), 2U) << t;
    const auto standing = [&] {
      return std::find_if(seen.moving.begin(), seen.moving.end(), [](const Body& body) {
        return distance(test::bounding_box(body).centre(), Vec2{900, 250}) < 5;
      });
    };
    ASSERT_NE(standing(), seen.moving.end());
    if (i == 0) standing_number = standing()->obstacle;
    EXPECT_EQ(standing()->obstacle, standing_number);
  }
}

TEST(SwarmPerception, AtFirstItMayBeAnywhereIfThatIsAllowed) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 2;
  const Vec2 far{800, 500};
  for (const bool anywhere : {false, true}) {
    Microscope microscope(optics, *map, 1, 0);
    PerceptionParams params = eye_params();
    params.start_anywhere = anywhere;
    SwarmPerception perception(params, {.radius = 40, .max_speed = 100}, *map, {{200, 300}, 0.5},
                               session_view(microscope));
    const auto look = [&](Vec2 position, double t) {
      return perception.process(
          microscope.look(Snapshot(map, t, {}), SwarmPose{{position, 0}, 40}, {}), t);
    };
    const Detections first = look(far, 0);
    EXPECT_EQ(first.swarm.has_value(), anywhere);
    if (!anywhere) {
      EXPECT_EQ(first.not_found, NotFound::far);
      continue;
    }
    EXPECT_LT(distance(first.swarm->pose.position, far), 3);
    EXPECT_EQ(first.swarm->pose.heading, 0.5) << "the way from its start is no motion";
    EXPECT_FALSE(look({200, 300}, 0.1).swarm) << "only at first";
  }
}

TEST(SwarmPerception, DiscsKeepTheirNumbersWhileTheirImagesJoin) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 4;
  Microscope microscope(optics, *map, 1, 0);
  PerceptionParams params = eye_params();
  params.scene.obstacles.gap = 2;
  SwarmPerception perception(params, {.max_speed = 100}, *map, {{200, 300}, 0},
                             session_view(microscope));
  for (int i = 0; i < 160; ++i) {
    const double t = 0.1 * i;
    // They pass each other, 6 µm from edge to edge: less than two pixels.
    const std::array<Disc, 2> discs{Disc{{500 + 25 * t, 450}, 60}, Disc{{900 - 25 * t, 586}, 70}};
    const Snapshot world(map, t, {{.shape = discs[0]}, {.shape = discs[1], .obstacle = 1}});
    const Detections& seen =
        perception.process(microscope.look(world, SwarmPose{{{200, 300}, 0}, 50}, {}), t);
    ASSERT_EQ(seen.moving.size(), 2U) << t;
    for (const Body& body : seen.moving) {
      ASSERT_TRUE(std::holds_alternative<Disc>(body.shape)) << t;
      const Disc& disc = std::get<Disc>(body.shape);
      const Disc& drawn = discs[disc.radius > 65 ? 0 + 1 : 0];
      EXPECT_LT(distance(disc.centre, drawn.centre), 4) << t;
      EXPECT_NEAR(disc.radius, drawn.radius, 4) << t;
      EXPECT_EQ(body.obstacle, disc.radius > 65 ? 0U : 1U) << t;
    }
  }
}

TEST(SwarmPerception, LeavesOfAValveAreOneObstacle) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 3.75;
  Microscope microscope(optics, *map, 1, 0);
  // As high as the channel, so that the wall cuts one leaf; closed at 7.5 s, open at 2.5 s.
  const Obstacle valve{Valve{.span = 700, .thickness = 60, .max_gap = 400, .period = 10},
                       Still{{700, 450}, 0}};
  SwarmPerception perception(eye_params(), {.max_speed = 100}, *map, {{200, 300}, 0},
                             session_view(microscope), std::span(&valve, 1));
  const navigation::WaitZone zone{
      .centre = {700, 450}, .width = 400, .height = 700, .min_gap = 200};
  const navigation::Waiting swarm{{560, 450}, 50, 75, {1100, 450}};
  int waits = 0;
  for (int i = 0; i < 120; ++i) {
    const double t = 0.1 * i;
    std::vector<Body> bodies;
    append_bodies(valve, 0, t, bodies);
    const double gap = navigation::gap_between(bodies[0], bodies[1]);
    bodies.push_back({.shape = Disc{{700 + 30 * t, 300}, 40}, .obstacle = 1});
    const Detections& seen = perception.process(
        microscope.look(Snapshot(map, t, bodies), SwarmPose{{{200, 300}, 0}, 50}, {}), t);
    const auto leaf = [](const Body& body) { return body.obstacle == 0; };
    if (t > 4) {  // the disc is out of the valve's way
      ASSERT_EQ(std::ranges::count_if(seen.moving, leaf), 2) << t;
      EXPECT_GT(test::bounding_box(seen.moving[seen.moving.size() - 2]).centre().y, 450) << t;
      EXPECT_NEAR(navigation::gap_between(seen.moving.end()[-2], seen.moving.end()[-1]), gap, 15)
          << t;
      if (std::abs(gap - zone.min_gap) > 15) {
        EXPECT_EQ(navigation::must_wait(zone, seen.moving, swarm), gap < zone.min_gap) << t;
      }
      waits += navigation::must_wait(zone, seen.moving, swarm);
    }
    for (const Body& body : seen.moving)
      if (std::holds_alternative<Disc>(body.shape)) {
        EXPECT_NE(body.obstacle, 0U) << t;
      }
  }
  EXPECT_GT(waits, 20);
}

TEST(SwarmPerception, AnObstacleMayShrinkButDirtIsNone) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 4;
  Microscope microscope(optics, *map, 1, 0);
  PerceptionParams params = eye_params();
  params.scene.obstacles.gap = 2;
  SwarmPerception perception(params, {.max_speed = 100}, *map, {{200, 300}, 0},
                             session_view(microscope));
  for (int i = 0; i < 40; ++i) {
    const double radius = 60 - i;  // the smallest obstacle has 32 µm
    const Snapshot world(
        map, 0.1 * i,
        {{.shape = Disc{{600, 500}, radius}}, {.shape = Disc{{900, 300}, 24}, .obstacle = 1}});
    const Detections& seen =
        perception.process(microscope.look(world, SwarmPose{{{200, 300}, 0}, 50}, {}), 0.1 * i);
    ASSERT_EQ(seen.moving.size(), 1U) << i;
    EXPECT_NEAR(std::get<Disc>(seen.moving[0].shape).radius, radius, 3) << i;
  }
}

TEST(SwarmPerception, NothingOfTheSwarmIsBeyondItsCircle) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 4;
  for (std::uint32_t trial = 0; trial < 10; ++trial) {
    Microscope microscope(optics, *map, 1, trial);
    SwarmPerception perception(eye_params(), {.max_speed = 100}, *map, {{400, 400}, 0},
                               session_view(microscope));
    for (int i = 0; i < 10; ++i) {
      const Detections& seen = perception.process(
          microscope.look(Snapshot(map, i), SwarmPose{{{400, 400}, 0}, 80}, {}), i);
      ASSERT_TRUE(seen.swarm);
      const double off = distance(seen.swarm->pose.position, Vec2{400, 400});
      EXPECT_LT(80 + off - seen.swarm->radius, 4) << trial << " " << i;  // a pixel
      EXPECT_LT(seen.swarm->radius, 84);
    }
  }
}

TEST(SwarmPerception, SaysWhyThereIsNone) {
  const auto map = channel();
  Microscope microscope({}, *map, 1, 0);
  SwarmPerception perception(eye_params(), {.max_speed = 100}, *map, {{200, 300}, 0},
                             session_view(microscope));
  const Detections& empty = perception.process(microscope.look(Snapshot(map), std::nullopt, {}), 0);
  EXPECT_FALSE(empty.swarm);
  EXPECT_EQ(empty.not_found, NotFound::none);
  formats::Image black = microscope.look(Snapshot(map), std::nullopt, {});
  std::fill(black.pixels.begin(), black.pixels.end(), std::uint8_t{0});
  EXPECT_FALSE(perception.process(black, 0.1).swarm);
}

TEST(SwarmPerception, TwoSwarmsAreNotGuessedBetween) {
  const auto map = channel();
  Microscope microscope({}, *map, 1, 0);
  SwarmPerception perception(eye_params(), {.max_speed = 100}, *map, {{300, 400}, 0},
                             session_view(microscope));
  formats::Image both = microscope.look(Snapshot(map), SwarmPose{{{260, 400}, 0}, 30}, {});
  const formats::Image right = microscope.look(Snapshot(map), SwarmPose{{{340, 400}, 0}, 30}, {});
  for (std::size_t i = 0; i < both.pixels.size(); ++i)
    both.pixels[i] = std::min(both.pixels[i], right.pixels[i]);
  const Detections& seen = perception.process(both, 0);
  EXPECT_FALSE(seen.swarm);
  EXPECT_EQ(seen.not_found, NotFound::several);
}

/// A swarm that goes to the right, seen for two seconds.
struct Followed {
  std::shared_ptr<const Map> map = channel();
  Microscope microscope{{}, *map, 1, 0};
  SwarmPerception perception{
      eye_params(), {.max_speed = 40}, *map, {{300, 400}, 0}, session_view(microscope)};
  double t = 0;
  Vec2 position{300, 400};

  const Detections& see(Vec2 at, double radius) {
    t += 0.1;
    return perception.process(microscope.look(Snapshot(map, t), SwarmPose{{at, 0}, radius}, {}), t);
  }
  Followed() {
    for (int i = 0; i < 20; ++i) {
      perception.commanded({0, 40}, t);
      position.x += 4;
      EXPECT_TRUE(see(position, 60).swarm) << i;
    }
  }
};

TEST(SwarmPerception, WhatItCannotHaveReachedIsNotTheSwarm) {
  Followed f;
  const Detections& seen = f.see(f.position + Vec2{120, 60}, 60);
  EXPECT_FALSE(seen.swarm);
  EXPECT_EQ(seen.not_found, NotFound::far);
  // It may come back to where it can have gone meanwhile.
  EXPECT_TRUE(f.see(f.position + Vec2{8, 0}, 60).swarm);
}

TEST(SwarmPerception, WhatIsOfAnotherSizeIsNotTheSwarm) {
  Followed f;
  for (int i = 0; i < 10; ++i) {
    const Detections& seen = f.see(f.position, 30);
    EXPECT_FALSE(seen.swarm);
    EXPECT_EQ(seen.not_found, NotFound::size);
  }
  EXPECT_TRUE(f.see(f.position, 55).swarm);
}

/// Darkens a disc of a picture, without texture.
void stain(formats::Image& picture, Vec2 at_px, double radius, double share) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (distance(at_px, Vec2{1.0 * x, 1.0 * y}) < radius) {
        std::uint8_t& grey = picture.pixels[picture.index(x, y)];
        grey = static_cast<std::uint8_t>(share * grey);
      }
}

/// A channel with a dense vortex that has no texture at this magnification.
struct Smooth {
  std::shared_ptr<const Map> map = channel();
  Microscope microscope{{}, *map, 1, 0};
  PerceptionParams params = eye_params();
  vision::CameraScale scale = microscope.scale();
  SwarmPerception perception{
      params, {.radius = 60, .max_speed = 40}, *map, {{300, 400}, 0}, session_view(microscope)};
  double t = 0;

  const Detections& see(const std::vector<Disc>& discs) {
    formats::Image picture = microscope.look(Snapshot(map, t += 0.1), std::nullopt, {});
    for (const Disc& disc : discs)
      stain(picture, scale.to_picture(disc.centre), disc.radius / scale.um_per_px, 0.4);
    return perception.process(picture, t);
  }
};

TEST(SwarmPerception, ADenseSmoothSwarmIsFollowed) {
  Smooth f;
  Vec2 position{305, 396};
  for (int i = 0; i < 30; ++i) {
    const Disc still{{800, 500}, 60};
    const Detections& seen = f.see({{position, 60}, still});
    ASSERT_TRUE(seen.swarm) << i;
    EXPECT_LT(distance(seen.swarm->pose.position, position), 3);
    ASSERT_EQ(seen.moving.size(), 1U);
    EXPECT_LT(distance(test::bounding_box(seen.moving[0]).centre(), still.centre), 5);
    position.x += 4;
  }
  // When it is gone, nothing else is taken for it.
  EXPECT_FALSE(f.see({{{800, 500}, 60}}).swarm);
}

TEST(SwarmPerception, ASmoothBodyElsewhereOrOfAnotherSizeIsNoSwarm) {
  Smooth f;
  EXPECT_FALSE(f.see({{{800, 500}, 60}}).swarm);
  EXPECT_FALSE(f.see({{{300, 400}, 100}}).swarm);
  EXPECT_FALSE(f.see({{{300, 400}, 30}}).swarm);
  EXPECT_FALSE(f.see({{{225, 400}, 58}, {{375, 400}, 60}}).swarm);
  EXPECT_TRUE(f.see({{{300, 400}, 60}}).swarm);
}

TEST(SwarmPerception, ASmoothBodyIsNeverTakenForASwarmThatHadTexture) {
  Followed f;
  formats::Image picture = f.microscope.look(Snapshot(f.map), std::nullopt, {});
  const vision::CameraScale scale = f.microscope.scale();
  stain(picture, scale.to_picture(f.position), 60 / scale.um_per_px, 0.4);
  const Detections& seen = f.perception.process(picture, f.t + 0.1);
  EXPECT_FALSE(seen.swarm);
  EXPECT_EQ(seen.not_found, NotFound::none);
  EXPECT_EQ(seen.moving.size(), 1U);
}

/// A picture of two swarms.
formats::Image both(Microscope& microscope, const std::shared_ptr<const Map>& map,
                    const SwarmPose& a, const SwarmPose& b) {
  formats::Image picture = microscope.look(Snapshot(map), a, {});
  const formats::Image other = microscope.look(Snapshot(map), b, {});
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = std::min(picture.pixels[i], other.pixels[i]);
  return picture;
}

TEST(SwarmPerception, ASplitIsToldWithItsParts) {
  for (const auto& [left, right] : {std::pair{43.0, 42.0}, {48.0, 34.0}}) {
    Followed f;
    const formats::Image picture = both(f.microscope, f.map, {{f.position - Vec2{60, 0}, 0}, left},
                                        {{f.position + Vec2{60, 0}, 0}, right});
    const Detections& seen = f.perception.process(picture, f.t + 0.1);
    EXPECT_FALSE(seen.swarm);
    EXPECT_EQ(seen.not_found, NotFound::split);
    ASSERT_EQ(seen.parts.size(), 2U);
    EXPECT_NEAR(std::max(seen.parts[0], seen.parts[1]), left, 6);
    EXPECT_NEAR(std::min(seen.parts[0], seen.parts[1]), right, 6);
  }
}

TEST(SwarmPerception, AMergerIsToldWithWhatMerged) {
  Followed f;
  const Vec2 second = f.position + Vec2{150, 0};
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(f.perception
                    .process(both(f.microscope, f.map, {{f.position, 0}, 60}, {{second, 0}, 55}),
                             f.t += 0.1)
                    .swarm);
  const Detections& seen = f.see(f.position + Vec2{12, 0}, 82);
  EXPECT_FALSE(seen.swarm);
  EXPECT_EQ(seen.not_found, NotFound::merged);
  ASSERT_EQ(seen.parts.size(), 2U);
  EXPECT_NEAR(seen.parts[0], 60, 6);
  EXPECT_NEAR(seen.parts[1], 55, 6);
}

TEST(SwarmPerception, SomethingNewBesideAWholeSwarmIsNoSplit) {
  Followed f;
  const Detections& seen = f.perception.process(
      both(f.microscope, f.map, {{f.position, 0}, 60}, {{f.position + Vec2{100, 0}, 0}, 25}),
      f.t + 0.1);
  EXPECT_NE(seen.not_found, NotFound::split);
  EXPECT_TRUE(seen.swarm);
}

TEST(SwarmPerception, MeasuresHowItFollows) {
  Followed f;
  f.perception.commanded({0, 40}, f.t);
  const Detections& along = f.see(f.position += Vec2{4, 0}, 60);
  EXPECT_NEAR(along.commanded_distance, 4, 1e-9);
  EXPECT_NEAR(along.followed_distance, 4, 2);
  double followed = 0;
  for (int i = 0; i < 20; ++i) {
    f.perception.commanded({0, 40}, f.t);
    followed += f.see(f.position += Vec2{0, 4}, 60).followed_distance;
  }
  EXPECT_NEAR(followed, 0, 5);  // of 80 µm
  EXPECT_NEAR(
      f.perception
          .process(f.microscope.look(Snapshot(f.map, f.t), SwarmPose{{f.position, 0}, 60}, {}), f.t)
          .across_distance,
      0, 1e-9);  // no time has passed
  f.perception.commanded({0, 40}, f.t);
  EXPECT_NEAR(f.see(f.position += Vec2{0, 4}, 60).across_distance, 4, 2);
}

TEST(FollowAngle, IsThatOfTheSeenWay) {
  for (const double turn : {-100.0, -15.0, 0.0, 20.0}) {
    FollowAngle angle;
    Rng rng(7, Purpose::test);
    EXPECT_FALSE(angle.direction());
    for (int i = 0; i < 400; ++i) {
      const Vec2 seen = 0.8 * unit_vector(turn * pi / 180) + 0.5 * Vec2{rng.normal(), rng.normal()};
      angle.take(1, seen.x, seen.y, 20);
    }
    const auto direction = angle.direction();
    ASSERT_TRUE(direction);
    EXPECT_NEAR(degrees(direction->angle), turn, 4 * degrees(direction->sd));
    EXPECT_LT(degrees(direction->sd), 4);
    EXPECT_GT(degrees(direction->sd), 0.4);
    EXPECT_NEAR(direction->share, 0.8, 0.1);
  }
}

}  // namespace
}  // namespace microswarm::rig
