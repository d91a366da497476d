// SPDX-License-Identifier: Apache-2.0
// What a rig makes of pictures, against what was drawn.
#include "microswarm/rig/perception/perception.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/prediction/body_numbers.hpp"
#include "microswarm/rig/perception/robot_perception.hpp"
#include "microswarm/rig/simulation/microscope.hpp"
#include "tests/rig/perceived.hpp"

namespace microswarm::rig {
namespace {

using test::channel;
using test::eye_params;
using test::session_view;

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
      eye_params(), RobotSwarmParams{}, *map, std::vector<Vec2>{}, session_view(microscope));
};

TEST_F(VanishingRobots, DustIsNotTwentyRobots) {
  for (int i = 0; i < 20; ++i) {
    const Detections& seen = see({{1000, 600}});
    EXPECT_FALSE(seen.swarm);
    EXPECT_EQ(seen.not_found, NotFound::robots);
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
                              [&](Vec2 position) { return distance(position, robot) < 3; }));
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
  RobotPerception perception(eye_params(), {}, *map, robots, session_view(microscope));
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

// 10 to 80 pixels wide.
TEST(RobotPerception, FindsTheCentresOfLargeRobots) {
  const auto map = channel();
  for (const double diameter : {10.0, 25.0, 50.0, 80.0}) {
    MicroscopeParams optics;
    optics.um_per_px = 2;
    optics.robot_diameter = diameter;
    Microscope microscope(optics, *map, 1, 0);
    std::vector<Vec2> robots{{200.3, 300.7}, {500.9, 500.2}, {900.4, 350.6}};
    PerceptionParams params = eye_params();
    params.robots = {.diameter = static_cast<int>(1.15 * diameter) | 1, .min_mass = 60};
    RobotPerception perception(params, {}, *map, robots, session_view(microscope));
    for (int frame = 1; frame < 10; ++frame) {
      for (Vec2& robot : robots) robot += Vec2{2.3, 1.1};
      const double t = frame / 45.0;
      const Detections& seen =
          perception.process(microscope.look(Snapshot(map, t), std::nullopt, robots), t);
      EXPECT_EQ(seen.unseen, 0) << diameter;
      for (std::size_t i = 0; i < robots.size(); ++i)
        EXPECT_LT(distance(seen.robots[i], robots[i]), 0.4) << diameter << " " << frame << " " << i;
    }
  }
}

TEST(RobotPerception, PilesAreSeenAsOneAndComeApartAgain) {
  const auto map = channel();
  MicroscopeParams optics;
  optics.um_per_px = 2;
  Microscope microscope(optics, *map, 1, 0);
  std::vector<Vec2> robots{{400, 400}, {600, 400}, {800, 600}};
  RobotPerception perception(eye_params(), {}, *map, robots, session_view(microscope));
  const auto see = [&](double t) -> const Detections& {
    return perception.process(microscope.look(Snapshot(map, t), std::nullopt, robots), t);
  };
  double t = 0;
  for (; robots[0].x < robots[1].x; robots[0].x += 4) see(t += 0.1);
  for (const Vec2 position : see(t += 0.1).robots)
    EXPECT_LT(std::min(distance(position, robots[1]), distance(position, robots[2])),
              7);  // its radius
  for (int i = 0; i < 40; ++i, robots[0].y += 4) see(t += 0.1);
  const Detections& apart = see(t += 0.1);
  const auto near = [&](Vec2 position) {
    return std::any_of(apart.robots.begin(), apart.robots.end(),
                       [&](Vec2 p) { return distance(p, position) < 3; });
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
  RobotPerception perception(params, {}, *map, starts, session_view(microscope));
  constexpr double near = 30;  // [µm]; a robot's picture is 16 µm wide
  const auto alone = [](Vec2 position, const std::vector<Vec2>& others) {
    return std::none_of(others.begin(), others.end(),
                        [&](Vec2 other) { return distance(position, other) < near; });
  };
  Lost lost;
  Command command;
  for (int frame = 0; frame < 300; ++frame) {
    if (frame % 10 == 0) command = {rng.uniform(-pi, pi), 150};
    const double t = 0.1 * frame;
    const std::vector<Vec2> positions = robots.positions();
    const Detections& seen =
        perception.process(microscope.look(Snapshot(map, t), std::nullopt, positions), t);
    for (const Vec2 position : positions) lost.unseen += alone(position, seen.robots);
    for (const Vec2 position : seen.robots) lost.ghosts += alone(position, positions);
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
  navigation::BodyNumbers numbers(50);
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

/// Numbers by all pairs within reach.
class NumbersOfAllPairs {
 public:
  explicit NumbersOfAllPairs(double reach) : reach_(reach) {}

  std::vector<std::uint32_t> number(const std::vector<Vec2>& positions) {
    std::vector<AssignmentEdge> edges;
    for (std::size_t i = 0; i < positions.size(); ++i)
      for (std::size_t k = 0; k < known_.size(); ++k) {
        const double off = squared_norm(positions[i] - known_[k]);
        if (off <= reach_ * reach_)
          edges.push_back({static_cast<int>(i), static_cast<int>(k), off});
      }
    const auto of = Assignment().solve(static_cast<int>(positions.size()),
                                       static_cast<int>(known_.size()), edges, reach_ * reach_);
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (!of[i]) known_.emplace_back();
      numbers.push_back(
          static_cast<std::uint32_t>(of[i] ? *of[i] : static_cast<int>(known_.size()) - 1));
      known_[numbers.back()] = positions[i];
    }
    return numbers;
  }

 private:
  double reach_;
  std::vector<Vec2> known_;
};

// Two pictures, so that no velocity is expected yet.
TEST(BodyNumbers, AreThoseOfAllPairs) {
  for (std::uint32_t trial = 0; trial < 100; ++trial) {
    Rng rng(11, Purpose::test, trial);
    const double reach = 30;
    const std::size_t count = 50 + rng.below(400);
    const double size = rng.uniform(300, 2000);
    navigation::BodyNumbers fast(reach);
    NumbersOfAllPairs slow(reach);
    std::vector<Vec2> positions;
    for (std::size_t i = 0; i < count; ++i)
      positions.push_back({rng.uniform(0, size), rng.uniform(0, size)});
    for (const double t : {0.0, 0.1}) {
      std::vector<Body> bodies;
      for (const Vec2 position : positions) bodies.push_back({.shape = Disc{position, 5}});
      fast.number(bodies, t);
      const std::vector<std::uint32_t> expected = slow.number(positions);
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(bodies[i].obstacle, expected[i]) << trial;
      for (Vec2& position : positions) position += Vec2{rng.uniform(-10, 10), rng.uniform(-10, 10)};
    }
  }
}

}  // namespace
}  // namespace microswarm::rig
