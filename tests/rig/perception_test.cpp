// SPDX-License-Identifier: Apache-2.0
// What a rig makes of pictures, against what was drawn.
#include "microswarm/rig/perception/perception.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/rig/perception/body_numbers.hpp"
#include "microswarm/rig/perception/robot_perception.hpp"
#include "microswarm/rig/perception/swarm_perception.hpp"
#include "microswarm/rig/simulation/microscope.hpp"

namespace microswarm {
namespace {

std::shared_ptr<const Map> channel() {
  return std::make_shared<const Map>(
      Box{{0, 0}, {1200, 800}},
      std::vector<Polygon>{{{{0, 0}, {1200, 0}, {1200, 100}, {0, 100}}, {}}});
}

Box bounding_box(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body.shape))
    return Box{disc->centre, disc->centre}.grown(disc->radius);
  return microswarm::bounding_box(std::get<Polygon>(body.shape));
}

CameraView view_of(const Microscope& m) { return {m.scale(), m.width(), m.height()}; }

PerceptionParams eye_params() {
  PerceptionParams p;
  p.edge = 1.5;
  p.scene.swarm.look.min_contrast = 80;
  p.scene.swarm.look.gap = 4;
  return p;
}

TEST(SwarmPerception, FollowsASwarmAmongObstacles) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 2;
  Microscope microscope(optics, *map, 1, 0);
  SwarmPerception perception(eye_params(), 100, *map, {{200, 300}, 0}, view_of(microscope));
  std::uint32_t standing_number = 0;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.1 * i;
    const Vec2 place{200 + 80 * t, 300 + 40 * t};
    const SwarmPose swarm{{place, 0}, 40};
    // One goes along with it, 8 µm from edge to edge; one stands.
    const Snapshot world(map, t,
                         {{.shape = Disc{place + Vec2{0, 108}, 60}, .obstacle = 0},
                          {.shape = Disc{{900, 250}, 50}, .obstacle = 1}});
    const Detections& seen = perception.process(microscope.look(world, swarm, {}), t);
    ASSERT_TRUE(seen.swarm) << t << " " << seen.trouble;
    EXPECT_LT(distance(seen.swarm->pose.position, place), 3) << t;
    EXPECT_NEAR(seen.swarm->radius, 40, 4);
    if (i > 5) {
      EXPECT_LT(turn_between(seen.swarm->pose.heading, std::atan2(1, 2)), 0.15);
    }
    ASSERT_EQ(seen.moving.size(), 2U) << t;
    const auto standing = [&] {
      return std::find_if(seen.moving.begin(), seen.moving.end(), [](const Body& body) {
        return distance(bounding_box(body).centre(), Vec2{900, 250}) < 5;
      });
    };
    ASSERT_NE(standing(), seen.moving.end());
    if (i == 0) standing_number = standing()->obstacle;
    EXPECT_EQ(standing()->obstacle, standing_number);
  }
}

TEST(SwarmPerception, DiscsKeepTheirNumbersWhileTheirImagesJoin) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 4;
  Microscope microscope(optics, *map, 1, 0);
  PerceptionParams params = eye_params();
  params.scene.obstacles.gap = 2;
  SwarmPerception perception(params, 100, *map, {{200, 300}, 0}, view_of(microscope));
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

TEST(SwarmPerception, AnObstacleMayShrinkButDirtIsNone) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 4;
  Microscope microscope(optics, *map, 1, 0);
  PerceptionParams params = eye_params();
  params.scene.obstacles.gap = 2;
  SwarmPerception perception(params, 100, *map, {{200, 300}, 0}, view_of(microscope));
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
    SwarmPerception perception(eye_params(), 100, *map, {{400, 400}, 0}, view_of(microscope));
    for (int i = 0; i < 10; ++i) {
      const Detections& seen = perception.process(
          microscope.look(Snapshot(map, i), SwarmPose{{{400, 400}, 0}, 80}, {}), i);
      ASSERT_TRUE(seen.swarm) << seen.trouble;
      const double off = distance(seen.swarm->pose.position, Vec2{400, 400});
      EXPECT_LT(80 + off - seen.swarm->radius, 4) << trial << " " << i;  // a pixel
      EXPECT_LT(seen.swarm->radius, 84);
    }
  }
}

TEST(SwarmPerception, SaysWhyThereIsNone) {
  const auto map = channel();
  Microscope microscope({}, *map, 1, 0);
  SwarmPerception perception(eye_params(), 100, *map, {{200, 300}, 0}, view_of(microscope));
  const Detections& empty = perception.process(microscope.look(Snapshot(map), std::nullopt, {}), 0);
  EXPECT_FALSE(empty.swarm);
  EXPECT_EQ(empty.trouble, "none");
  Image black = microscope.look(Snapshot(map), std::nullopt, {});
  std::fill(black.pixels.begin(), black.pixels.end(), std::uint8_t{0});
  EXPECT_FALSE(perception.process(black, 0.1).swarm);
}

TEST(SwarmPerception, TwoSwarmsAreNotGuessedBetween) {
  const auto map = channel();
  Microscope microscope({}, *map, 1, 0);
  SwarmPerception perception(eye_params(), 100, *map, {{300, 400}, 0}, view_of(microscope));
  Image both = microscope.look(Snapshot(map), SwarmPose{{{260, 400}, 0}, 30}, {});
  const Image right = microscope.look(Snapshot(map), SwarmPose{{{340, 400}, 0}, 30}, {});
  for (std::size_t i = 0; i < both.pixels.size(); ++i)
    both.pixels[i] = std::min(both.pixels[i], right.pixels[i]);
  const Detections& seen = perception.process(both, 0);
  EXPECT_FALSE(seen.swarm);
  EXPECT_EQ(seen.trouble, "several");
}

/// A swarm that goes to the right, seen for two seconds.
struct Followed {
  std::shared_ptr<const Map> map = channel();
  Microscope microscope{{}, *map, 1, 0};
  SwarmPerception perception{eye_params(), 40, *map, {{300, 400}, 0}, view_of(microscope)};
  double t = 0;
  Vec2 place{300, 400};

  const Detections& see(Vec2 at, double radius) {
    t += 0.1;
    return perception.process(microscope.look(Snapshot(map, t), SwarmPose{{at, 0}, radius}, {}), t);
  }
  Followed() {
    for (int i = 0; i < 20; ++i) {
      perception.commanded({0, 40}, t);
      place.x += 4;
      EXPECT_TRUE(see(place, 60).swarm) << i;
    }
  }
};

TEST(SwarmPerception, WhatItCannotHaveReachedIsNotTheSwarm) {
  Followed f;
  const Detections& seen = f.see(f.place + Vec2{120, 60}, 60);
  EXPECT_FALSE(seen.swarm);
  EXPECT_EQ(seen.trouble, "far");
  // It may come back to where it can have gone meanwhile.
  EXPECT_TRUE(f.see(f.place + Vec2{8, 0}, 60).swarm);
}

TEST(SwarmPerception, WhatIsOfAnotherSizeIsNotTheSwarm) {
  Followed f;
  for (int i = 0; i < 10; ++i) {
    const Detections& seen = f.see(f.place, 30);
    EXPECT_FALSE(seen.swarm);
    EXPECT_EQ(seen.trouble, "size");
  }
  EXPECT_TRUE(f.see(f.place, 55).swarm);
}

TEST(SwarmPerception, MeasuresHowItFollows) {
  Followed f;
  f.perception.commanded({0, 40}, f.t);
  const Detections& along = f.see(f.place += Vec2{4, 0}, 60);
  EXPECT_NEAR(along.commanded_way, 4, 1e-9);
  EXPECT_NEAR(along.followed_way, 4, 2);
  double followed = 0;
  for (int i = 0; i < 20; ++i) {
    f.perception.commanded({0, 40}, f.t);
    followed += f.see(f.place += Vec2{0, 4}, 60).followed_way;
  }
  EXPECT_NEAR(followed, 0, 5);  // of 80 µm
}

/// Robots that are seen for a second, then vanish but for a few.
class VanishingRobots : public testing::Test {
 protected:
  VanishingRobots() {
    for (int i = 0; i < 20; ++i) robots.push_back({150.0 + 90 * (i % 5), 250.0 + 100 * (i / 5)});
    for (int i = 0; i < 10; ++i) {
      const Detections& all = see(robots);
      EXPECT_TRUE(all.swarm);
      EXPECT_EQ(all.unseen, 0);
    }
  }
  const Detections& see(const std::vector<Vec2>& there) {
    t += 0.1;
    return perception->process(microscope.look(Snapshot(map, t), std::nullopt, there), t);
  }

  std::shared_ptr<const Map> map = channel();
  MicroscopeParams optics{.um_per_px = 2};
  Microscope microscope{optics, *map, 1, 0};
  std::vector<Vec2> robots;
  double t = 0;
  std::unique_ptr<RobotPerception> perception = std::make_unique<RobotPerception>(
      eye_params(), RobotSwarmParams{}, *map, std::vector<Vec2>{}, view_of(microscope));
};

TEST_F(VanishingRobots, DustIsNotTwentyRobots) {
  for (int i = 0; i < 20; ++i) {
    const Detections& seen = see({{1000, 600}});
    EXPECT_FALSE(seen.swarm);
    EXPECT_EQ(seen.trouble, "robots");
    EXPECT_GE(seen.unseen, 19);
  }
}

TEST_F(VanishingRobots, AFewUnseenAreCountedAndStayWhereTheyAreExpected) {
  const std::vector<Vec2> most(robots.begin(), robots.end() - 3);
  for (int i = 0; i < 20; ++i) {
    const Detections& seen = see(most);
    EXPECT_TRUE(seen.swarm);
    EXPECT_EQ(seen.unseen, 3);
    for (const Vec2 robot : robots)
      EXPECT_TRUE(std::any_of(seen.robots.begin(), seen.robots.end(),
                              [&](Vec2 place) { return distance(place, robot) < 3; }));
  }
  EXPECT_EQ(see(robots).unseen, 0);
}

TEST_F(VanishingRobots, NoneAtAllIsNoSwarm) {
  EXPECT_EQ(see({}).unseen, 20);
  EXPECT_FALSE(see({}).swarm);
  EXPECT_EQ(see(robots).unseen, 0);
}

TEST(RobotPerception, KnowsEveryRobotWhileTheyAreApart) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 2;
  Microscope microscope(optics, *map, 1, 0);
  std::vector<Vec2> robots;
  for (int i = 0; i < 60; ++i) robots.push_back({150.0 + 90 * (i % 10), 150.0 + 100 * (i / 10)});
  RobotPerception perception(eye_params(), {}, *map, robots, view_of(microscope));
  Rng rng(3, Purpose::test);
  for (int frame = 1; frame < 30; ++frame) {
    for (Vec2& robot : robots) robot += Vec2{2 + rng.normal(), 1 + rng.normal()};
    const double t = frame / 45.0;
    perception.commanded({std::atan2(1, 2), std::sqrt(5.0) * 45}, t);
    const Detections& seen =
        perception.process(microscope.look(Snapshot(map, t), std::nullopt, robots), t);
    ASSERT_EQ(seen.robots.size(), robots.size());
    for (std::size_t i = 0; i < robots.size(); ++i)
      EXPECT_LT(distance(seen.robots[i], robots[i]), 1.5) << frame << " " << i;
  }
}

TEST(RobotPerception, PilesAreSeenAsOneAndComeApartAgain) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 2;
  Microscope microscope(optics, *map, 1, 0);
  std::vector<Vec2> robots{{400, 400}, {600, 400}, {800, 600}};
  RobotPerception perception(eye_params(), {}, *map, robots, view_of(microscope));
  const auto see = [&](double t) -> const Detections& {
    return perception.process(microscope.look(Snapshot(map, t), std::nullopt, robots), t);
  };
  double t = 0;
  for (; robots[0].x < robots[1].x; robots[0].x += 4) see(t += 0.1);
  for (const Vec2 place : see(t += 0.1).robots)
    EXPECT_LT(std::min(distance(place, robots[1]), distance(place, robots[2])), 7);  // its radius
  for (int i = 0; i < 40; ++i, robots[0].y += 4) see(t += 0.1);
  const Detections& apart = see(t += 0.1);
  const auto near = [&](Vec2 place) {
    return std::any_of(apart.robots.begin(), apart.robots.end(),
                       [&](Vec2 p) { return distance(p, place) < 3; });
  };
  for (const Vec2 robot : robots) EXPECT_TRUE(near(robot));
}

/// Robots driven to and fro, with piles at the walls and in dim light; the shares of robot and
/// picture for which nothing is seen near a robot, and no robot is near what is seen.
struct Lost {
  double unseen = 0;
  double ghosts = 0;
};
Lost drive_to_and_fro(int count) {
  const auto map = std::make_shared<const Map>(
      Box{{0, 0}, {1200, 800}},
      std::vector<Polygon>{{{{0, 0}, {1200, 0}, {1200, 100}, {0, 100}}, {}},
                           {{{400, 300}, {700, 350}, {650, 600}, {450, 500}}, {}}});
  MicroscopeParams optics;
  optics.um_per_px = 4;
  optics.robot_diameter = 4;
  optics.light_gradient = 0.3;
  Microscope microscope(optics, *map, 1, 0);
  PerceptionParams params = eye_params();
  params.robots = {.diameter = 5, .min_mass = 60, .separation = 3};
  Rng rng(5, Purpose::test);
  std::vector<Vec2> starts;
  while (std::ssize(starts) < count) {
    const Vec2 p{rng.uniform(0, 1200), rng.uniform(0, 800)};
    if (map->is_free(p, 5)) starts.push_back(p);
  }
  const RobotStepper stepper(*map, 15);
  Robots robots = stepper.place(starts);
  RobotPerception perception(params, {}, *map, starts, view_of(microscope));
  constexpr double near = 30;  // [µm]; a robot's picture is 16 µm wide
  const auto alone = [](Vec2 place, const std::vector<Vec2>& others) {
    return std::none_of(others.begin(), others.end(),
                        [&](Vec2 other) { return distance(place, other) < near; });
  };
  Lost lost;
  Command command;
  for (int frame = 0; frame < 300; ++frame) {
    if (frame % 10 == 0) command = {rng.uniform(-pi, pi), 150};
    const double t = 0.1 * frame;
    const std::vector<Vec2> places = robots.positions();
    const Detections& seen =
        perception.process(microscope.look(Snapshot(map, t), std::nullopt, places), t);
    for (const Vec2 place : places) lost.unseen += alone(place, seen.robots);
    for (const Vec2 place : seen.robots) lost.ghosts += alone(place, places);
    perception.commanded(command, t);
    stepper.step(robots, displacement(command, 0.1), ContactRule::stop);
  }
  lost.unseen /= 300.0 * count;
  lost.ghosts /= 300.0 * count;
  return lost;
}

TEST(RobotPerception, LosesNoneAtWallsAndInPiles) {
  for (const int count : {20, 150}) {
    const Lost lost = drive_to_and_fro(count);
    EXPECT_LT(lost.unseen, 0.01) << count;
    EXPECT_LT(lost.ghosts, 0.01) << count;
  }
}

TEST(BodyNumbers, StayWithTheirBodies) {
  BodyNumbers numbers(50);
  for (int i = 0; i < 100; ++i) {
    const double x = 10.0 * i;
    std::vector<Body> bodies{{.shape = Disc{{x, 0}, 10}}, {.shape = Disc{{1000 - x, 30}, 12}}};
    if (i % 2) std::swap(bodies[0], bodies[1]);
    if (i % 7 == 6) bodies.pop_back();
    numbers.number(bodies, 0.1 * i);
    for (const Body& body : bodies)
      EXPECT_EQ(body.obstacle, std::get<Disc>(body.shape).radius == 10 ? 0U : 1U) << i;
  }
  std::vector<Body> far{{.shape = Disc{{5000, 0}, 10}}};
  numbers.number(far, 10);
  EXPECT_EQ(far[0].obstacle, 2U);
}

}  // namespace
}  // namespace microswarm
