// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/safety_filter.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/swarm/body/unicycle.hpp"
#include "plain_safety_filter.hpp"

namespace microswarm::navigation {
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

/// Drives a swarm that wants what `wants(t, position)` says, and the guard allows.
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
      return Command{heading_along(goal - p), distance(goal, p) > 10 ? guard_speed : 0};
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

/// Solids of every kind that turn as they move, often into the swarm.
std::vector<Body> crowd(int kinds, double t, Rng rng) {
  std::vector<Body> bodies;
  const int count = 4 + static_cast<int>(rng.below(6));
  for (int i = 0; i < count; ++i) {
    const Vec2 from{rng.uniform(1500, 2500), rng.uniform(1500, 2500)};
    const double speed = rng.uniform(0, 1.5) * guard_speed;
    const Vec2 at = from + t * speed * unit_vector(rng.uniform(-pi, pi));
    const double turn = rng.uniform(-1, 1) * t;
    Body body{.shape = Disc{at, rng.uniform(30, 100)}, .obstacle = static_cast<std::uint32_t>(i)};
    if (kinds > 1 && i % 2 == 0) body.shape = scenes::turned_rectangle(at, 250, 80, turn);
    if (kinds > 2 && i % 3 == 0) {  // an angle, which the swarm may be within the hull of
      Polygon angle{{{-150, -150}, {150, -150}, {150, -80}, {-80, -80}, {-80, 150}, {-150, 150}},
                    {}};
      for (Vec2& v : angle.outer) v = at + rotated(v, turn);
      body.shape = angle;
    }
    bodies.push_back(body);
  }
  return bodies;
}

/// Tunings whose ways turn between two instants, at them, and at a first or last one.
std::vector<SafetyFilterParams> various_filters() {
  std::vector<SafetyFilterParams> all(4);
  all[1].step = 0.13;
  all[1].directions = 17;
  all[1].commitment = 0;
  all[2].horizon = 2;
  all[2].step = 0.5;
  all[2].tuning.turn_times = {0.1, 0.5, 2, 3};
  all[2].tuning.gap_tolerance = 0;
  all[3].gap = 60;
  all[3].tuning.counted_gap = 20;
  all[3].tuning.min_escapes = 12;
  return all;
}

bool same_bits(const std::optional<Command>& a, const std::optional<Command>& b) {
  return a.has_value() == b.has_value() &&
         (!a || (a->heading == b->heading && a->speed == b->speed));
}

/// What became of decisions that were compared.
struct Compared {
  int overruled = 0;
  int held = 0;
};

/// A drive of `ticks` among a crowd, on which both filters decide the same to the bit.
void compare(const std::shared_ptr<const Map>& map, const SafetyFilterParams& params, int trial,
             int ticks, Compared& out) {
  Rng rng(static_cast<std::uint64_t>(trial), Purpose::test);
  SafetyFilter fast(params, guard_speed);
  PlainSafetyFilter plain(params, guard_speed);
  Pose2 pose{{2000, 2000}, 0};
  for (int k = 0; k < ticks; ++k) {
    const double t = 0.15 * k;
    const Snapshot world(map, t, crowd(1 + trial % 3, t, Rng(99, Purpose::scene, trial)));
    const Observation seen{.now = t,
                           .seen = t,
                           .swarm = SwarmPose{pose, guard_radius},
                           .robots = {},
                           .world = borrowed(world)};
    fast.update(seen);
    plain.update(seen);
    const Command wanted{rng.uniform(-pi, pi), rng.uniform(0, 1.2 * guard_speed)};
    const EscapeStart start{pose.position, guard_radius, t + 0.1};
    const auto instead = fast.filter(wanted, start, world, guard_tick);
    ASSERT_TRUE(same_bits(instead, plain.filter(wanted, start, world, guard_tick)))
        << trial << ", tick " << k;
    out.overruled += instead ? 1 : 0;
    out.held += instead && instead->speed == 0 ? 1 : 0;
    pose = unicycle_step(pose, instead.value_or(wanted), std::numeric_limits<double>::infinity(),
                         0.15);
  }
}

TEST(SafetyFilter, DecidesAsThePlainOne) {
  const auto walled = std::make_shared<const Map>(
      Box{{1400, 1400}, {2600, 2600}},
      std::vector<Polygon>{scenes::turned_rectangle({1900, 2100}, 300, 60, 0.4)});
  Compared sum;
  for (int trial = 0; trial < 24; ++trial)
    compare(trial % 2 == 0 ? walled : open_ground(),
            various_filters()[static_cast<std::size_t>(trial % 4)], trial, 12, sum);
  EXPECT_GT(sum.overruled, 100);
  EXPECT_GT(sum.held, 5);
}

/// Discs all round the swarm that close in.
std::vector<Body> closing_ring(double t, std::uint32_t first, Rng rng) {
  std::vector<Body> bodies;
  for (int i = 0; i < 9; ++i) {
    const Vec2 towards = unit_vector(wrap(2 * pi * i / 9 + rng.uniform(-0.2, 0.2)));
    const double away = rng.uniform(150, 260) - t * rng.uniform(20, 120);
    bodies.push_back({.shape = Disc{Vec2{2000, 2000} + away * towards, 60}, .obstacle = first++});
  }
  return bodies;
}

// An escape that was commanded is not kept to once nothing moves nearby.
TEST(SafetyFilter, ForgetsItsEscapeWhenTheDangerIsOver) {
  int overruled = 0;
  for (std::uint32_t trial = 0; trial < 40; ++trial) {
    SafetyFilter filter({}, guard_speed);
    SafetyFilter fresh({}, guard_speed);
    for (int k = 0; k < 9; ++k) {
      const double t = guard_tick * k;
      std::vector<Body> bodies;
      if (k < 4) bodies = closing_ring(t, 0, Rng(1, Purpose::test, trial));
      if (k > 5) bodies = closing_ring(t - 0.6, 100, Rng(2, Purpose::test, trial));
      const Snapshot world(open_ground(), t, std::move(bodies));
      const Observation seen{.now = t,
                             .seen = t,
                             .swarm = SwarmPose{{{2000, 2000}, 0}, guard_radius},
                             .robots = {},
                             .world = borrowed(world)};
      const EscapeStart start{{2000, 2000}, guard_radius, t};
      filter.update(seen);
      const auto command = filter.filter({0, guard_speed}, start, world, guard_tick);
      if (k <= 5) continue;
      fresh.update(seen);
      const auto expected = fresh.filter({0, guard_speed}, start, world, guard_tick);
      EXPECT_TRUE(same_bits(command, expected)) << trial << ", tick " << k;
      overruled += command ? 1 : 0;
    }
  }
  EXPECT_GT(overruled, 80);
}

/// Rooms with up to three walls about the swarm, some hardly wider than it.
std::vector<std::shared_ptr<const Map>> rooms(int count) {
  Rng rng(5, Purpose::scene);
  std::vector<std::shared_ptr<const Map>> all;
  for (int k = 0; k < count; ++k) {
    std::vector<Polygon> walls;
    for (int i = 0; i < k % 4; ++i) {
      const Vec2 at = Vec2{2000, 2000} + rng.uniform(120, 500) * unit_vector(rng.uniform(-pi, pi));
      walls.push_back(scenes::turned_rectangle(at, rng.uniform(50, 400), 40, rng.uniform(-pi, pi)));
    }
    const double half = rng.uniform(100, 1000);
    const Box bounds{{2000 - half, 2000 - half}, {2000 + half, 2000 + half}};
    all.push_back(std::make_shared<const Map>(bounds, walls));
  }
  return all;
}

TEST(SafetyFilter, DecidesAsThePlainOneInManyScenes) {
  const auto maps = rooms(40);
  Compared sum;
  for (int trial = 0; trial < 1000; ++trial) {
    SafetyFilterParams params;
    if (trial % 5 == 0) params = various_filters()[static_cast<std::size_t>(trial / 5 % 4)];
    compare(maps[static_cast<std::size_t>(trial) % maps.size()], params, 1000 + trial, 4, sum);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(sum.overruled, 1000);
  EXPECT_GT(sum.held, 100);
}

}  // namespace
}  // namespace microswarm::navigation
