// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/safety_filter.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/swarm/body/unicycle.hpp"

namespace microswarm {
namespace {

constexpr double guard_tick = 0.1;
constexpr double guard_radius = 50;
constexpr double guard_speed = 80;

std::shared_ptr<const Map> open_ground() {
  static const auto map =
      std::make_shared<const Map>(Box{{0, 0}, {4000, 4000}}, std::vector<Polygon>{});
  return map;
}

/// Something that goes straight.
struct Mover {
  Vec2 start;
  Vec2 velocity;
  double radius = 60;
};

std::vector<Body> at(const std::vector<Mover>& movers, double t) {
  std::vector<Body> bodies;
  for (const Mover& m : movers)
    bodies.push_back({.shape = Disc{m.start + t * m.velocity, m.radius},
                      .obstacle = static_cast<std::uint32_t>(bodies.size())});
  return bodies;
}

/// What became of a swarm that was driven for a while.
struct Drive {
  double min_gap = std::numeric_limits<double>::infinity();
  double turning = 0;  ///< of what was commanded [rad]
  int overruled = 0;
};

/// Drives a swarm that wants what `wants(t, place)` says, and the guard allows.
template <class Wants>
Drive drive(const std::vector<Mover>& movers, Vec2 start, double seconds, Wants&& wants) {
  SafetyFilter guard({}, guard_speed);
  Pose2 pose{start, 0};
  Drive out;
  std::optional<double> course;
  for (int k = 0; guard_tick * k < seconds; ++k) {
    const double t = guard_tick * k;
    const Snapshot world(open_ground(), t, at(movers, t));
    out.min_gap =
        std::min(out.min_gap, world.moving().clearance(pose.position, 1e4) - guard_radius);
    guard.update({.now = t,
                  .seen = t,
                  .swarm = SwarmPose{pose, guard_radius},
                  .robots = {},
                  .world = borrowed(world)});
    Command command = wants(t, pose.position);
    if (const auto instead =
            guard.filter(command, {pose.position, guard_radius, t}, world, guard_tick)) {
      command = *instead;
      ++out.overruled;
    }
    if (command.speed > 0) {
      if (course) out.turning += turn_between(command.heading, *course);
      course = command.heading;
    }
    pose = unicycle_step(pose, command, std::numeric_limits<double>::infinity(), guard_tick);
  }
  return out;
}

TEST(SafetyFilter, LetsBeWhereNothingIsNear) {
  const Drive d = drive({{{3500, 3500}, {0, 0}}}, {500, 500}, 5, [](double, Vec2) {
    return Command{0.3, guard_speed};
  });
  EXPECT_EQ(d.overruled, 0);
}

TEST(SafetyFilter, GetsOutOfTheWayOfWhatComes) {
  const Drive d =
      drive({{{1000, 2000}, {60, 0}}}, {1500, 2010}, 20, [](double, Vec2) { return Command{}; });
  EXPECT_GT(d.min_gap, 0);
  EXPECT_GT(d.overruled, 0);
}

TEST(SafetyFilter, DoesNotDriveInto) {
  const Drive d = drive({{{2500, 2000}, {0, 0}}}, {1500, 2000}, 20, [](double, Vec2) {
    return Command{0, guard_speed};
  });
  EXPECT_GT(d.min_gap, 0);
  EXPECT_LT(d.min_gap, 30);  // it does not keep farther off than it must
}

// Straight at a goal behind what stands or moves: once past, once round, but not to and fro.
TEST(SafetyFilter, TurnsNoMoreThanItMust) {
  Rng rng(4, Purpose::test);
  double most = 0, sum = 0;
  constexpr int trials = 60;
  for (int trial = 0; trial < trials; ++trial) {
    const Vec2 goal{2600, 2000};
    std::vector<Mover> movers;
    for (int i = 0; i < 3; ++i) {
      const double v = rng.uniform(0, 0.6) * guard_speed;
      movers.push_back({{rng.uniform(1800, 2400), rng.uniform(1700, 2300)},
                        v * unit_vector(rng.uniform(-pi, pi)),
                        rng.uniform(30, 100)});
    }
    const Drive d = drive(movers, {1500, 2000}, 20, [&](double, Vec2 p) {
      return Command{heading_of(goal - p), distance(goal, p) > 10 ? guard_speed : 0};
    });
    ASSERT_GT(d.min_gap, 0) << trial;
    most = std::max(most, d.turning);
    sum += d.turning;
  }
  EXPECT_LT(degrees(sum / trials), 300);
  EXPECT_LT(degrees(most), 1500);
}

// Whatever is wanted: what is slower and goes straight does not touch.
TEST(SafetyFilter, AnyDriverIsSafeAmongAFewThatGoStraight) {
  Rng rng(3, Purpose::test);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec2 start{2000, 2000};
    std::vector<Mover> movers;
    while (movers.size() < 3) {
      const double v = rng.uniform(0, 0.8) * guard_speed;
      const Vec2 from = start + rng.uniform(250, 700) * unit_vector(rng.uniform(-pi, pi));
      movers.push_back({from, v * unit_vector(rng.uniform(-pi, pi))});
    }
    Command wanted;
    const Drive d = drive(movers, start, 12, [&](double, Vec2) {
      if (rng.below(10) == 0) wanted = {rng.uniform(-pi, pi), rng.uniform(0, guard_speed)};
      return wanted;
    });
    ASSERT_GT(d.min_gap, 0) << trial;
  }
}

}  // namespace
}  // namespace microswarm
