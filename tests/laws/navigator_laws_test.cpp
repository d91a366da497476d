// SPDX-License-Identifier: Apache-2.0
// Laws that every navigator of a swarm seen as one body keeps, whatever the world.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/navigation/radar/radar.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/swarm/body/unicycle.hpp"
#include "tests/laws/allocations.hpp"
#include "tests/laws/body_navigators.hpp"

namespace microswarm {
namespace {

constexpr double tick = 0.1;
constexpr double radius = 30;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr SwarmLimits swarm{
    .radius = radius, .max_speed = 70, .max_turn_rate = infinity, .response_lag = 0.1};

/// Discs that cross a room with some walls. Places are pure in t.
struct Scene {
  std::shared_ptr<const Map> map;
  std::vector<Vec2> from, velocity;
  std::vector<double> radii;
  Vec2 start, goal;

  Snapshot at(double t) const {
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < from.size(); ++i)
      bodies.push_back({.shape = Disc{from[i] + t * velocity[i], radii[i]},
                        .obstacle = static_cast<std::uint32_t>(i)});
    return Snapshot(map, t, std::move(bodies));
  }
};

Scene random_scene(std::uint32_t trial, int movers = 6) {
  Rng rng(21, Purpose::scene, trial);
  Scene scene;
  std::vector<Polygon> walls;
  for (int i = 0; i < 3; ++i)
    walls.push_back(scenes::turned_rectangle({rng.uniform(300, 900), rng.uniform(100, 700)},
                                             rng.uniform(20, 120), rng.uniform(10, 60),
                                             rng.uniform(0, 3)));
  scene.map = std::make_shared<const Map>(Box{{0, 0}, {1200, 800}}, walls, std::vector<Disc>{}, 5);
  scene.start = {120, rng.uniform(120, 680)};
  scene.goal = {1080, rng.uniform(120, 680)};
  for (int i = 0; i < movers; ++i) {
    scene.from.push_back({rng.uniform(300, 1000), rng.uniform(0, 800)});
    scene.velocity.push_back(rng.uniform(0, 50) * unit_vector(rng.uniform(-3, 3)));
    scene.radii.push_back(rng.uniform(10, 60));
  }
  return scene;
}

Observation see(const Snapshot& world, const Pose2& pose, double now) {
  return {.now = now,
          .seen = now - 0.05,
          .swarm = SwarmPose{pose, radius},
          .robots = {},
          .world = borrowed(world)};
}

class NavigatorLaws : public testing::TestWithParam<BodyNavigator> {
 protected:
  std::unique_ptr<Navigator> make(Vec2 goal, std::uint64_t seed = 1) const {
    return make(goal, 20, swarm, seed);
  }
  std::unique_ptr<Navigator> make(Vec2 goal, double tolerance, const SwarmLimits& limits,
                                  std::uint64_t seed = 1) const {
    const navigation::Task task{
        .swarm = limits, .robots = {}, .goal = goal, .goal_tolerance = tolerance, .tick = tick};
    return navigation::make_navigator(GetParam().params, task, Rng(seed, Purpose::planner));
  }

  /// Steers a swarm for some ticks; `watch(world, pose, command, state)` sees each.
  template <class Watch>
  void drive(const Scene& scene, int ticks, Watch&& watch) const {
    const auto navigator = make(scene.goal);
    Pose2 pose{scene.start, 0};
    Command active;  // obeyed a tick late
    for (int k = 0; k < ticks; ++k) {
      const Snapshot world = scene.at(tick * k);
      if (k == 0) navigator->prepare(world, {});
      const Command command = navigator->step(see(world, pose, tick * k), {});
      watch(world, pose, command, *navigator);
      pose = unicycle_step(pose, active, swarm.max_turn_rate, tick);
      active = command;
    }
  }
};

// In every build, and after any other run.
TEST_P(NavigatorLaws, SameSeedSameBits) {
  Hash hash;
  for (std::uint32_t trial = 0; trial < 6; ++trial)
    drive(random_scene(trial), 120, [&](auto&, auto&, const Command& c, const Navigator& n) {
      hash.value(c.heading);
      hash.value(c.speed);
      hash.text(enum_name(n.view().state));
    });
  EXPECT_EQ(hash.digest(), GetParam().golden) << "0x" << hash.hex();
}

TEST_P(NavigatorLaws, CommandsAreWithinLimits) {
  for (std::uint32_t trial = 0; trial < 20; ++trial)
    drive(random_scene(trial), 150, [&](auto&, auto&, const Command& c, auto&) {
      ASSERT_TRUE(std::isfinite(c.heading) && std::isfinite(c.speed));
      ASSERT_GE(c.speed, 0);
      ASSERT_LE(c.speed, swarm.max_speed);
    });
}

TEST_P(NavigatorLaws, GetsThereInTheOpen) {
  Scene scene = random_scene(0, 0);
  scene.map = std::make_shared<const Map>(Box{{0, 0}, {1200, 800}}, std::vector<Polygon>{});
  double left = infinity;
  bool arrived = false;
  drive(scene, 400, [&](auto&, const Pose2& pose, const Command& c, const Navigator& n) {
    left = std::min(left, distance(pose.position, scene.goal));
    if (n.view().state != NavigatorState::arrived) return;
    arrived = true;
    EXPECT_EQ(c.speed, 0);
  });
  EXPECT_LE(left, 20);
  EXPECT_TRUE(arrived);
}

/// What a navigator keeps from walls at the least [µm]: of the goals that the check lets through,
/// what the radar as published gets to.
double min_clearance(const navigation::NavigatorParams& params) {
  const auto* radar = std::get_if<navigation::RadarParams>(&params);
  if (radar && radar->as_published) return radius + radar->safety_distance;
  return std::max(navigation::required_clearance(params), radius);
}

// The goal itself is too near to the border, a point within its tolerance is not.
TEST_P(NavigatorLaws, GetsNearAGoalBesideAWall) {
  const bool repelled = std::holds_alternative<navigation::PotentialFieldParams>(GetParam().params);
  const bool published = GetParam().name == "RadarAsPublished";
  for (const double share : {0.3, 0.6, 0.88})
    for (const bool corner : {false, true}) {
      if (repelled && (share > 0.6 || corner)) continue;
      if (published && corner) continue;
      Scene scene = random_scene(0, 0);
      scene.map = std::make_shared<const Map>(Box{{0, 0}, {1200, 800}}, std::vector<Polygon>{});
      const double free = min_clearance(GetParam().params);
      scene.goal = {800, free - share * 20};
      if (corner) scene.goal = Vec2{1200 - free, free} + share * 20 * unit_vector(-pi / 4);
      bool arrived = false;
      Vec2 last;
      drive(scene, 400, [&](const Snapshot& world, const Pose2& pose, auto&, const Navigator& n) {
        arrived |= n.view().state == NavigatorState::arrived;
        last = pose.position;
        // The pose is newer than the observation says, so that it goes a little too far.
        ASSERT_GE(world.clearance(pose.position), radius - 0.5 * tick * swarm.max_speed)
            << share << (corner ? ", in the corner" : "");
      });
      EXPECT_TRUE(arrived) << share << (corner ? ", in the corner" : "") << ", goal "
                           << scene.goal.y << ", stopped at " << last.x << ", " << last.y;
    }
}

// However small its tolerance, and whichever way a swarm looks that turns slowly.
TEST_P(NavigatorLaws, GetsToASmallGoalAlongAWall) {
  const auto map = std::make_shared<const Map>(Box{{0, 0}, {1200, 800}}, std::vector<Polygon>{});
  if (GetParam().name == "RadarAsPublished" ||
      std::holds_alternative<navigation::PotentialFieldParams>(GetParam().params))
    GTEST_SKIP() << "is repelled by the wall";
  if (std::holds_alternative<navigation::PathNavigatorParams>(GetParam().params))
    GTEST_SKIP() << "follows its path once, and does not go round again";
  for (const double turn_rate : {infinity, 3.0, 0.8})
    for (const double tolerance : {5.0, 10.0})
      for (const double beyond : {-0.5 * tolerance, 0.0, 5.0})
        for (const double heading : {0.0, 2.6}) {
          SwarmLimits limits = swarm;
          limits.max_turn_rate = turn_rate;
          const Vec2 goal{800, min_clearance(GetParam().params) + beyond};
          const auto navigator = make(goal, tolerance, limits);
          Pose2 pose{{300, 300}, heading};
          Command active;
          std::optional<NavigatorState> state;
          for (int k = 0; k < 600 && state != NavigatorState::arrived; ++k) {
            const Snapshot world(map, tick * k);
            if (k == 0) navigator->prepare(world, {});
            const Command command = navigator->step(see(world, pose, tick * k), {});
            state = navigator->view().state;
            pose = unicycle_step(pose, active, turn_rate, tick);
            active = command;
          }
          EXPECT_EQ(state, NavigatorState::arrived)
              << "turning at " << turn_rate << " rad/s, tolerance " << tolerance << ", " << beyond
              << " beyond, heading " << heading << ": stopped at " << pose.position.x << ", "
              << pose.position.y << ", goal " << goal.y;
        }
}

TEST_P(NavigatorLaws, HoldsWithoutAGoodLook) {
  const Scene scene = random_scene(1, 0);
  const Snapshot world = scene.at(0);
  const auto navigator = make(scene.goal);
  navigator->prepare(world, {});
  const Observation good = see(world, {scene.start, 0}, 0);
  double now = 0;
  const auto expect_hold = [&](Observation bad, const char* what) {
    now += tick;
    const double age = bad.now - bad.seen;
    bad.now = now;
    bad.seen = now - age;
    const Command c = navigator->step(bad, {});
    EXPECT_EQ(c.speed, 0) << what;
    EXPECT_TRUE(std::isfinite(c.heading)) << what;
    EXPECT_EQ(navigator->view().state, NavigatorState::blind) << what;
  };
  Observation bad = good;
  bad.swarm.reset();
  expect_hold(bad, "no swarm");
  bad = good;
  bad.swarm->pose.position.y = nan;
  expect_hold(bad, "no number");
  bad = good;
  bad.swarm->pose.heading = infinity;
  expect_hold(bad, "no heading");
  bad = good;
  bad.seen -= 3;
  expect_hold(bad, "stale");
  bad = good;
  bad.world = nullptr;
  expect_hold(bad, "no world");
  // And goes on when it sees again.
  now += tick;
  EXPECT_GT(navigator->step(see(world, {scene.start, 0}, now), {}).speed, 0);
}

TEST_P(NavigatorLaws, HoldsInAWall) {
  Scene scene = random_scene(0, 0);
  scene.map = std::make_shared<const Map>(
      Box{{0, 0}, {1200, 800}}, std::vector<Polygon>{scenes::rectangle({{300, 300}, {700, 500}})});
  const Snapshot world = scene.at(0);
  const auto navigator = make(scene.goal);
  navigator->prepare(world, {});
  EXPECT_EQ(navigator->step(see(world, {{500, 400}, 0}, 0), {}).speed, 0);
  EXPECT_EQ(navigator->view().state, NavigatorState::blind);
}

// However it came there, it is steered again as soon as it is out.
TEST_P(NavigatorLaws, OutOfAnObstacleItGoesOn) {
  Scene scene = random_scene(0, 1);
  scene.map = std::make_shared<const Map>(Box{{0, 0}, {1200, 800}}, std::vector<Polygon>{});
  scene.radii[0] = 50;
  const Vec2 on_path = scene.start + 0.3 * (scene.goal - scene.start);
  for (const Vec2 off : {Vec2{}, Vec2{20, 10}, Vec2{-45, 0}, Vec2{0, 70}}) {
    const auto navigator = make(scene.goal);
    Command last;
    for (int k = 0; k < 12; ++k) {
      scene.from[0] = k < 7 ? on_path : Vec2{600, 3000};
      const Snapshot world = scene.at(0);
      const Vec2 p = k == 0 ? scene.start : on_path + off;
      if (k == 0) navigator->prepare(world, {});
      last = navigator->step(see(world, {p, 0}, tick * k), {});
      ASSERT_TRUE(std::isfinite(last.heading) && std::isfinite(last.speed));
      ASSERT_GE(last.speed, 0);
      ASSERT_LE(last.speed, swarm.max_speed);
    }
    EXPECT_GT(last.speed, 0) << off.x << ", " << off.y;
  }
}

TEST_P(NavigatorLaws, TouchesNothingWhenBlockedAllAround) {
  Scene scene = random_scene(0, 0);
  const double in = radius + 4, out = in + 20;
  const Vec2 c{600, 400};
  scene.map = std::make_shared<const Map>(
      Box{{0, 0}, {1200, 800}},
      std::vector<Polygon>{scenes::rectangle({c + Vec2{-out, -out}, c + Vec2{out, -in}}),
                           scenes::rectangle({c + Vec2{-out, in}, c + Vec2{out, out}}),
                           scenes::rectangle({c + Vec2{-out, -out}, c + Vec2{-in, out}}),
                           scenes::rectangle({c + Vec2{in, -out}, c + Vec2{out, out}})},
      std::vector<Disc>{}, 2);
  scene.start = c;
  double moved = 0;
  drive(scene, 60, [&](const Snapshot& world, const Pose2& pose, auto&, auto&) {
    ASSERT_TRUE(world.is_free(pose.position, radius));
    moved = std::max(moved, distance(pose.position, c));
  });
  EXPECT_LT(moved, 4);
}

TEST_P(NavigatorLaws, StepsAllocateNothing) {
  if (GetParam().allocates) GTEST_SKIP() << "calls a planner";
  const Scene scene = random_scene(3, 12);
  std::vector<Snapshot> worlds;
  for (int k = 0; k < 120; ++k) worlds.push_back(scene.at(tick * k));
  const auto navigator = make(scene.goal);
  navigator->prepare(worlds[0], {});
  Pose2 pose{scene.start, 0};
  std::size_t made = 0;
  for (int k = 0; k < 120; ++k) {
    const Observation seen = see(worlds[static_cast<std::size_t>(k)], pose, tick * k);
    const std::size_t before = laws::allocations();
    const Command command = navigator->step(seen, {});
    if (k >= 20) made += laws::allocations() - before;
    pose = unicycle_step(pose, command, swarm.max_turn_rate, tick);
  }
  EXPECT_EQ(made, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, NavigatorLaws, testing::ValuesIn(body_navigators()),
                         [](const auto& c) { return c.param.name; });

// Radar alone: measured by asking every body and wall, no command leads into what is screened.
TEST(RadarLaws, NoCommandIntoAScreenedDirection) {
  navigation::RadarParams params;
  params.target_gain = 0.01;
  params.compensate_delay = false;
  int avoided = 0, held = 0;
  for (std::uint32_t trial = 0; trial < 40; ++trial) {
    const Scene scene = random_scene(trial, 10);
    params.retreat = trial % 2 == 0;
    navigation::RadarNavigator navigator(params,
                                         {.swarm = swarm, .goal = scene.goal, .goal_tolerance = 20},
                                         Rng(1, Purpose::planner));
    Pose2 pose{scene.start, 0};
    for (int k = 0; k < 200; ++k) {
      const Snapshot world = scene.at(tick * k);
      const Command c = navigator.step(see(world, pose, tick * k), {});
      const auto state = navigator.view().state;
      held += state == NavigatorState::hold;
      if (state == NavigatorState::direct || state == NavigatorState::avoid) {
        const double step = state == NavigatorState::direct
                                ? std::min(25.0, distance(pose.position, scene.goal))
                                : 25.0;
        const Vec2 position = pose.position + step * unit_vector(c.heading);
        ASSERT_GE(world.clearance(position), radius + 25 - 1e-9) << trial << ", " << k;
        avoided += state == NavigatorState::avoid;
      } else {
        ASSERT_EQ(c.speed > 0, state == NavigatorState::retreat || state == NavigatorState::guard)
            << enum_name(state);
      }
      pose = unicycle_step(pose, c, swarm.max_turn_rate, tick);
    }
  }
  EXPECT_GT(avoided, 500);
  EXPECT_GT(held, 0);
}

}  // namespace
}  // namespace microswarm
