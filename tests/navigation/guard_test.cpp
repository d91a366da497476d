// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/guard.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/rng.hpp"
#include "microswarm/swarm/unicycle.hpp"
#include "tests/scenes/worlds.hpp"

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

/// Drives a swarm that wants what `wants` says, and the guard allows.
template <class Wants>
double least_gap(const std::vector<Mover>& movers, Vec2 start, double seconds, Wants&& wants,
                 int* overruled = nullptr) {
  Guard guard({}, guard_speed);
  Pose2 pose{start, 0};
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; guard_tick * k < seconds; ++k) {
    const double t = guard_tick * k;
    const Snapshot world(open_ground(), t, at(movers, t));
    least = std::min(least, world.moving().clearance(pose.position, 1e4) - guard_radius);
    guard.see({.now = t,
               .seen = t,
               .swarm = SwarmPose{pose, guard_radius},
               .robots = {},
               .world = &world});
    Command command = wants(t);
    if (const auto instead =
            guard.overrules(command, {pose.position, guard_radius, t}, world.map(), guard_tick)) {
      command = *instead;
      if (overruled) ++*overruled;
    }
    pose = unicycle_step(pose, command, std::numeric_limits<double>::infinity(), guard_tick);
  }
  return least;
}

TEST(Guard, LetsBeWhereNothingIsNear) {
  int overruled = 0;
  least_gap(
      {{{3500, 3500}, {0, 0}}}, {500, 500}, 5,
      [](double) {
        return Command{0.3, guard_speed};
      },
      &overruled);
  EXPECT_EQ(overruled, 0);
}

TEST(Guard, GetsOutOfTheWayOfWhatComes) {
  int overruled = 0;
  const double least = least_gap(
      {{{1000, 2000}, {60, 0}}}, {1500, 2010}, 20, [](double) { return Command{}; }, &overruled);
  EXPECT_GT(least, 0);
  EXPECT_GT(overruled, 0);
}

TEST(Guard, DoesNotDriveInto) {
  const double least = least_gap({{{2500, 2000}, {0, 0}}}, {1500, 2000}, 20, [](double) {
    return Command{0, guard_speed};
  });
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 30);  // it does not keep farther off than it must
}

// Whatever is wanted: what is slower and goes straight does not touch.
TEST(Guard, AnyDriverIsSafeAmongAFewThatGoStraight) {
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
    const double least = least_gap(movers, start, 12, [&](double) {
      if (rng.below(10) == 0) wanted = {rng.uniform(-pi, pi), rng.uniform(0, guard_speed)};
      return wanted;
    });
    ASSERT_GT(least, 0) << trial;
  }
}

}  // namespace
}  // namespace microswarm
