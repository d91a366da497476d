// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/hierarchical.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/swarm/body/swarm_body.hpp"
#include "microswarm/swarm/body/unicycle.hpp"
#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

std::unique_ptr<Navigator> navigator(const Snapshot& world, std::uint64_t seed = 1) {
  auto made = make_navigator(HierarchicalParams{}, body_task(swarm_limits(RibbonParams{})),
                             Rng(seed, Purpose::planner));
  made->prepare(world, {});
  return made;
}

Observation update(const Snapshot& world, Vec2 at, double heading = 0, double now = 0) {
  return {.now = now, .seen = now, .swarm = SwarmPose{{at, heading}, 40}, .world = borrowed(world)};
}

TEST(Hierarchical, DrivesInTheOpen) {
  const Snapshot world = room_with();
  const auto n = navigator(world);
  const Command c = n->step(update(world, {300, 500}), {});
  EXPECT_GT(c.speed, 0);
  EXPECT_EQ(n->view().state, NavigatorState::follow);
  EXPECT_TRUE(n->view().planned);
  ASSERT_TRUE(n->view().local_target);
}

TEST(Hierarchical, HoldsWhenBlind) {
  const Snapshot world = room_with();
  const auto n = navigator(world);
  Observation none = update(world, {300, 500});
  none.swarm.reset();
  EXPECT_EQ(n->step(none, {}).speed, 0);
  EXPECT_EQ(n->view().state, NavigatorState::blind);
  Observation stale = update(world, {300, 500}, 0, 5);
  stale.seen = 4;
  EXPECT_EQ(n->step(stale, {}).speed, 0);
  Observation bad = update(world, {std::numeric_limits<double>::quiet_NaN(), 500}, 0, 6);
  EXPECT_EQ(n->step(bad, {}).speed, 0);
  Observation no_world = update(world, {300, 500}, 0, 7);
  no_world.world = nullptr;
  EXPECT_EQ(n->step(no_world, {}).speed, 0);
}

TEST(Hierarchical, HoldsAtTheGoal) {
  const Snapshot world = room_with();
  const auto n = navigator(world);
  EXPECT_EQ(n->step(update(world, {1790, 500}), {}).speed, 0);
  EXPECT_EQ(n->view().state, NavigatorState::arrived);
}

TEST(Hierarchical, HoldsWhenEverythingIsBlocked) {
  // A box just around the swarm: nowhere to go, and holding is as good as anything.
  const std::vector<Polygon> walls{{.outer = {{200, 380}, {400, 380}, {400, 400}, {200, 400}}},
                                   {.outer = {{200, 600}, {400, 600}, {400, 620}, {200, 620}}},
                                   {.outer = {{180, 380}, {200, 380}, {200, 620}, {180, 620}}},
                                   {.outer = {{400, 380}, {420, 380}, {420, 620}, {400, 620}}}};
  const Snapshot world = room_with(walls);
  const auto n = navigator(world);
  for (int k = 0; k < 5; ++k) {
    const Command c = n->step(update(world, {300, 500}, 0, 0.1 * k), {});
    if (c.speed <= 0) continue;
    const Pose2 next = unicycle_step({{300, 500}, 0}, c, 3, 0.1);
    EXPECT_TRUE(world.is_free(Segment{{300, 500}, next.position}, 80));
  }
}

TEST(Hierarchical, GetsOutOfTheWayOfWhatComesAtIt) {
  double x = 700;
  Pose2 pose{{300, 500}, 0};
  const Snapshot start = room_with({}, {{.shape = Disc{{x, 500}, 60}, .obstacle = 0}});
  const auto n = navigator(start);
  double least = 1e9;
  for (int k = 0; k < 200; ++k) {
    const Snapshot world = room_with({}, {{.shape = Disc{{x, 500}, 60}, .obstacle = 0}});
    const Command c = n->step(update(world, pose.position, pose.heading, 0.1 * k), {});
    pose = unicycle_step(pose, c, 3, 0.1);
    x -= 4;
    least = std::min(least, distance(pose.position, Vec2{x, 500}) - 60);
  }
  EXPECT_GE(least, 90 - 1e-6);
  EXPECT_LE(distance(pose.position, room_goal), 900);
}

std::uint64_t commands_hash(std::uint64_t seed) {
  const Snapshot world = room_with({}, {{.shape = Disc{{900, 480}, 120}, .obstacle = 0}});
  const auto n = navigator(world, seed);
  Pose2 pose{{300, 500}, 1};
  Hash hash;
  for (int k = 0; k < 150; ++k) {
    const Command c = n->step(update(world, pose.position, pose.heading, 0.1 * k), {});
    hash.value(c.heading);
    hash.value(c.speed);
    pose = unicycle_step(pose, c, 3, 0.1);
  }
  EXPECT_GT(pose.position.x, 700);
  return hash.digest();
}

TEST(Hierarchical, AnotherSeedPlansOtherwise) { EXPECT_NE(commands_hash(5), commands_hash(6)); }

/// Drives a ribbon for `seconds` in a world of discs that go straight; what came of it.
struct Driven {
  Pose2 pose;
  double least = 1e9;    ///< from its centre to anything [µm]
  double turned = 0;     ///< [rad]
  double arrived = 1e9;  ///< [s]
};

struct StraightDisc {
  Vec2 start, velocity;
  double radius;
};

Driven drive(Pose2 pose, Vec2 goal, double seconds, const std::vector<StraightDisc>& discs = {},
             const HierarchicalParams& params = {}) {
  const auto map = room_with().shared_map();
  const auto world_at = [&](double t) {
    std::vector<Body> bodies;
    bodies.reserve(discs.size());
    for (const StraightDisc& d : discs)
      bodies.push_back(
          {Disc{d.start + t * d.velocity, d.radius}, static_cast<std::uint32_t>(bodies.size())});
    return Snapshot(map, t, std::move(bodies));
  };
  const auto made = make_navigator(params,
                                   Task{.swarm = swarm_limits(RibbonParams{}),
                                        .robots = {},
                                        .goal = goal,
                                        .goal_tolerance = room_tolerance},
                                   Rng(1, Purpose::planner));
  made->prepare(world_at(0), {});
  Driven out{.pose = pose};
  for (double t = 0; t < seconds; t += 0.1) {
    const Snapshot world = world_at(t);
    const Command c = made->step(update(world, out.pose.position, out.pose.heading, t), {});
    const Pose2 next = unicycle_step(out.pose, c, RibbonParams{}.max_turn_rate, 0.1);
    out.turned += turn_between(out.pose.heading, next.heading);
    out.pose = next;
    out.least = std::min(out.least, world_at(t + 0.1).clearance(next.position));
    if (distance(next.position, goal) > room_tolerance) continue;
    out.arrived = t;
    break;
  }
  return out;
}

// The check before a run accepts them: a point within nine tenths of the tolerance keeps the
// margin.
TEST(Hierarchical, ReachesGoalsNearerToAWallThanTheMargin) {
  for (const double y : {89.0, 85.0, 75.0, 66.0, 63.5})
    EXPECT_LT(drive({{300, 500}, 0}, {1500, y}, 60).arrived, 40) << y;
}

// A ribbon turns only while it moves: facing the wall it comes a little nearer at first.
TEST(Hierarchical, LeavesAStartInsideTheMarginWhateverItFaces) {
  for (const double short_by : {1.0, 10.0, 25.0})
    for (const double heading : {-pi / 2, -pi / 3, 0.0, pi / 2, pi}) {
      const Driven d = drive({{300, 90 - short_by}, heading}, {1500, 500}, 60);
      EXPECT_LT(d.arrived, 45) << short_by << ", " << heading;
      EXPECT_GT(d.least, 45) << short_by << ", " << heading;
    }
}

// Two discs cross the way: it waits or goes round, but neither circles nor is driven along.
TEST(Hierarchical, LetsCrossingDiscsPass) {
  const Driven d = drive({{200, 500}, 0}, {1800, 500}, 80,
                         {{{900, 980}, {0, -50}, 90}, {{1400, 20}, {0, 40}, 90}});
  EXPECT_GE(d.least, 90);
  EXPECT_LT(d.arrived, 50);
  EXPECT_LT(d.turned, 2 * pi);
}

TEST(Hierarchical, AsPublishedLooksNotAheadAndPlansOnWhatIsSeen) {
  const HierarchicalParams published{.as_published = true};
  EXPECT_EQ(published.in_effect().horizon, 0);
  EXPECT_TRUE(published.in_effect().planner.as_published);
  EXPECT_LT(drive({{200, 500}, 0}, {1800, 500}, 80, {}, published).arrived, 40);
  // Something a little slower than the swarm comes at it: only what is ours gets out of the way.
  const std::vector<StraightDisc> oncoming{{{1500, 500}, {-55, 0}, 80}};
  EXPECT_LT(drive({{200, 500}, 0}, {1800, 500}, 80, oncoming, published).least, 90);
  EXPECT_GE(drive({{200, 500}, 0}, {1800, 500}, 80, oncoming).least, 90);
}

TEST(Hierarchical, AsPublishedSwitchesOffEveryAdditionOfOurs) {
  HierarchicalParams params{.as_published = true};
  params.follower = {.kind = FollowerKind::learned, .correct_flow = true};
  const HierarchicalParams published = params.in_effect();
  EXPECT_EQ(published.extra_clearance, 0);
  EXPECT_EQ(published.target_horizon, 0);
  EXPECT_EQ(published.guide, Guide::straight);
  EXPECT_EQ(published.follower.kind, FollowerKind::pure_pursuit);
  EXPECT_FALSE(published.follower.correct_flow);
  EXPECT_FALSE(published.planner.straighten);
  EXPECT_FALSE(published.planner.arcs);
  EXPECT_EQ(published.tuning.patience, infinity);
}

/// Corridors between the cells of a grid, one way from each cell to each, or more.
struct Maze {
  std::shared_ptr<const Map> map;
  Pose2 start;
  Vec2 goal;
};

Maze random_maze(Rng& rng) {
  const int nx = 5 + static_cast<int>(rng.below(4)), ny = 4 + static_cast<int>(rng.below(2));
  const double lane = std::array{120.0, 130.0, 160.0, 200.0, 260.0}[rng.below(5)];
  const double wall = std::array{20.0, 40.0, 80.0}[rng.below(3)];
  const double pitch = lane + wall;
  const auto number = [&](int x, int y) { return static_cast<std::size_t>(y * nx + x); };
  std::vector<bool> east(number(0, ny)), north(number(0, ny)), seen(number(0, ny));
  std::vector<std::pair<int, int>> stack{{0, 0}};
  seen[0] = true;
  while (!stack.empty()) {
    const auto [x, y] = stack.back();
    std::vector<std::pair<int, int>> next;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int u = x + dx, v = y + dy;
      if (u >= 0 && u < nx && v >= 0 && v < ny && !seen[number(u, v)]) next.emplace_back(u, v);
    }
    if (next.empty()) {
      stack.pop_back();
      continue;
    }
    const auto [u, v] = next[rng.below(next.size())];
    (u != x ? east : north)[number(std::min(x, u), std::min(y, v))] = true;
    seen[number(u, v)] = true;
    stack.emplace_back(u, v);
  }
  for (int extra = 0; extra < 3; ++extra) {
    const auto x = static_cast<int>(rng.below(static_cast<std::uint64_t>(nx) - 1));
    const auto y = static_cast<int>(rng.below(static_cast<std::uint64_t>(ny) - 1));
    if (rng.below(3) == 0) (rng.below(2) == 0 ? east : north)[number(x, y)] = true;
  }
  std::vector<Polygon> walls;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      const Vec2 corner{x * pitch, y * pitch};
      if (x + 1 < nx && !east[number(x, y)])
        walls.push_back(
            scenes::rectangle({corner + Vec2{lane, -wall}, corner + Vec2{pitch, pitch}}));
      if (y + 1 < ny && !north[number(x, y)])
        walls.push_back(
            scenes::rectangle({corner + Vec2{-wall, lane}, corner + Vec2{pitch, pitch}}));
    }
  const auto cell = [&](int x, std::uint64_t y) {
    return Vec2{x * pitch + lane / 2, static_cast<double>(y) * pitch + lane / 2};
  };
  const auto rows = static_cast<std::uint64_t>(ny);
  return {std::make_shared<const Map>(Box{{0, 0}, {nx * pitch - wall, ny * pitch - wall}},
                                      std::move(walls)),
          {cell(0, rng.below(rows)), rng.uniform(-pi, pi)},
          cell(nx - 1, rng.below(rows))};
}

// Lanes are 16 µm and more wider than twice the clearance.
TEST(Hierarchical, TakesTheShortestWayThroughStillMazes) {
  const HierarchicalParams params{.clearance = 52, .speed = 80};
  Rng rng(7, Purpose::test);
  for (int number = 0; number < 50; ++number) {
    SCOPED_TRACE(number);
    const Maze maze = random_maze(rng);
    const SwarmLimits swarm = number % 2 == 0
                                  ? swarm_limits(VortexParams{.radius = 40, .moving_radius = 40})
                                  : swarm_limits(RibbonParams{.max_speed = 80});
    const double shortest = planning::ShortestPaths(*maze.map, params.clearance)
                                .find(maze.start.position, maze.goal)
                                .length;
    ASSERT_GT(shortest, 0);
    HierarchicalNavigator n(params, body_task(swarm, maze.goal), Rng(1, Purpose::planner));
    const Snapshot world(maze.map);
    n.prepare(world, {});
    Pose2 pose = maze.start;
    double driven = 0, least = infinity;
    for (int k = 0; k < 3000 && distance(pose.position, maze.goal) > room_tolerance; ++k) {
      const Command c = n.step(update(world, pose.position, pose.heading, 0.1 * k), {});
      const Pose2 next = unicycle_step(pose, c, swarm.max_turn_rate, 0.1);
      driven += distance(pose.position, next.position);
      least = std::min(least, maze.map->clearance(Segment{pose.position, next.position}, 100));
      pose = next;
    }
    EXPECT_LE(distance(pose.position, maze.goal), room_tolerance);
    EXPECT_LE(driven, 1.1 * shortest + 100);
    EXPECT_GE(least, 48);
  }
}

// What comes near is none of the route's business: it chooses in space and time. So it does in
// sight of the goal.
TEST(Hierarchical, LeavesTheRouteWhenABodyIsNear) {
  const auto map = room_with({{{{950, 0}, {1050, 0}, {1050, 700}, {950, 700}}, {}}}).shared_map();
  HierarchicalNavigator n(HierarchicalParams{}, body_task(swarm_limits(RibbonParams{})),
                          Rng(1, Purpose::planner));
  const Snapshot still(map);
  n.prepare(still, {});
  n.step(update(still, {300, 300}, 0, 0), {});
  EXPECT_EQ(n.view().local_target, room_goal);
  const auto with_disc_at = [&](Vec2 centre, double t) {
    return Snapshot(map, t, {{.shape = Disc{centre, 60}, .obstacle = 0}});
  };
  const Snapshot far = with_disc_at({1600, 100}, 0.1);
  n.step(update(far, {300, 300}, 0, 0.1), {});
  EXPECT_EQ(n.view().local_target, room_goal);
  const Snapshot near = with_disc_at({700, 700}, 0.2);
  n.step(update(near, {300, 300}, 0, 0.2), {});
  EXPECT_NE(n.view().local_target, room_goal);
  const Snapshot in_sight = with_disc_at({100, 100}, 0.3);
  n.step(update(in_sight, {1200, 400}, 0, 0.3), {});
  EXPECT_NE(n.view().local_target, room_goal);
}

/// The steps at which it plans, of some on the straight path to the goal.
int plans_on_the_path(const HierarchicalParams& params, Vec2 from, int steps) {
  const Snapshot world = room_with();
  HierarchicalNavigator navigator(params, body_task(swarm_limits(RibbonParams{})),
                                  Rng(1, Purpose::planner));
  navigator.prepare(world, {});
  Pose2 pose{from, 0};
  int plans = 0;
  for (int k = 0; k < steps; ++k) {
    const Command c = navigator.step(update(world, pose.position, pose.heading, 0.1 * k), {});
    plans += navigator.view().planned;
    pose = unicycle_step(pose, c, RibbonParams{}.max_turn_rate, 0.1);
  }
  return plans;
}

// The first path reaches the goal, 200 µm ahead.
TEST(Hierarchical, PlansOnceWhereThePathHolds) {
  for (const bool as_published : {false, true})
    EXPECT_EQ(plans_on_the_path({.as_published = as_published}, room_goal - Vec2{200, 0}, 20), 1)
        << as_published;
}

TEST(Hierarchical, ShowsAPhasedGoalOfItsRouteOnly) {
  const Snapshot world = room_with();
  for (const Guide guide : {Guide::straight, Guide::route}) {
    HierarchicalNavigator n({.guide = guide}, body_task(swarm_limits(RibbonParams{})),
                            Rng(1, Purpose::planner));
    n.prepare(world, {});
    n.step(update(world, {300, 500}), {});
    EXPECT_EQ(n.view().phased_goal.has_value(), guide == Guide::route);
  }
}

// Extra clearance is kept where it fits: not in a passage that is too narrow for it.
TEST(Hierarchical, PathsKeepTheExtraClearanceWhereItFits) {
  for (const double half : {95.0, 130.0}) {
    const Snapshot world =
        room_with({{{{500, 0}, {900, 0}, {900, 500 - half}, {500, 500 - half}}, {}},
                   {{{500, 500 + half}, {900, 500 + half}, {900, 1000}, {500, 1000}}, {}}});
    HierarchicalNavigator n({.extra_clearance = 30}, body_task(swarm_limits(RibbonParams{})),
                            Rng(1, Purpose::planner));
    n.prepare(world, {});
    n.step(update(world, {300, 520}), {});
    const auto path = n.view().path;
    ASSERT_GE(path.size(), 2u);
    double least = 1e9;
    for (std::size_t i = 1; i < path.size(); ++i)
      least = std::min(least, world.map().clearance(Segment{path[i - 1], path[i]}, 1e4));
    EXPECT_GE(least, half > 120 ? 120 - 1e-9 : 90 - 1e-9) << half;
  }
}

// A drift across its path is compensated, once it is known.
TEST(Hierarchical, CorrectsTheFlow) {
  HierarchicalParams params;
  params.follower.correct_flow = true;
  const Snapshot world = room_with();
  HierarchicalNavigator navigator(params, body_task(swarm_limits(RibbonParams{})),
                                  Rng(1, Purpose::planner));
  navigator.prepare(world, {});
  Pose2 pose{{300, 500}, 0};
  Command last;
  for (int k = 0; k < 80; ++k) {
    last = navigator.step(update(world, pose.position, pose.heading, 0.1 * k), {});
    pose = unicycle_step(pose, last, RibbonParams{}.max_turn_rate, 0.1);
    pose.position.y += 0.1 * 20;
  }
  EXPECT_NEAR(last.speed * std::sin(last.heading), -20, 4);
  EXPECT_NEAR(pose.position.y, 500, 15);
}

TEST(Hierarchical, AsPublishedRefusesWhatIsNotThePapers) {
  EXPECT_TRUE(validate(HierarchicalParams{.as_published = true}, {}).empty());
  const HierarchicalParams both{.horizon = 5, .as_published = true};
  EXPECT_FALSE(validate(both, {}).empty());
}

}  // namespace
}  // namespace microswarm::navigation
