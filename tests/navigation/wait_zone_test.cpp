// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/wait_zone.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm::navigation {
namespace {

/// A valve across a passage that runs upwards, 400 µm wide at x = 0; its leaves lie at y = ±20.
std::vector<Body> valve(double gap) {
  const Obstacle obstacle{Valve{.span = 400, .min_gap = gap, .max_gap = gap},
                          Still{.position = {0, 0}, .heading = radians(90)}};
  std::vector<Body> bodies;
  append_bodies(obstacle, 0, 0, bodies);
  return bodies;
}

const WaitZone area{.centre = {0, 0}, .width = 600, .height = 600, .min_gap = 120};

Waiting swarm(Vec2 at, Vec2 target = {0, 1000}) { return {at, 50, 75, target}; }

TEST(GapBetween, Shapes) {
  const auto disc = [](Vec2 c, double r) { return Body{.shape = Disc{c, r}}; };
  const auto box = [](Box b) { return Body{.shape = scenes::rectangle(b)}; };
  EXPECT_DOUBLE_EQ(gap_between(disc({0, 0}, 10), disc({50, 0}, 15)), 25);
  EXPECT_DOUBLE_EQ(gap_between(disc({0, 0}, 30), disc({50, 0}, 25)), 0);
  EXPECT_DOUBLE_EQ(gap_between(disc({0, 0}, 10), box({{30, -5}, {40, 5}})), 20);
  EXPECT_DOUBLE_EQ(gap_between(box({{30, -5}, {40, 5}}), disc({0, 0}, 10)), 20);
  EXPECT_DOUBLE_EQ(gap_between(box({{0, 0}, {10, 10}}), box({{13, 14}, {20, 20}})), 5);
  EXPECT_DOUBLE_EQ(gap_between(box({{0, 0}, {10, 10}}), box({{2, 2}, {4, 4}})), 0);
}

TEST(WaitZone, WaitsBeforeAValveThatIsTooNarrow) {
  EXPECT_TRUE(must_wait(area, valve(100), swarm({0, -200})));
  EXPECT_TRUE(must_wait(area, valve(0), swarm({0, -200})));
  EXPECT_FALSE(must_wait(area, valve(140), swarm({0, -200})));
}

TEST(WaitZone, BeginsWithTheEdgeOfTheSwarm) {
  EXPECT_TRUE(must_wait(area, valve(0), swarm({0, -349})));
  EXPECT_FALSE(must_wait(area, valve(0), swarm({0, -351})));
}

TEST(WaitZone, GoesOnWhereLeavesCouldCloseOnIt) {
  EXPECT_FALSE(must_wait(area, valve(100), swarm({0, 0})));
  EXPECT_FALSE(must_wait(area, valve(100), swarm({0, -90})));  // 70 µm from the leaves' way
  EXPECT_TRUE(must_wait(area, valve(100), swarm({0, -100})));
}

TEST(WaitZone, GoesOnBeyondTheValve) {
  EXPECT_FALSE(must_wait(area, valve(0), swarm({0, 200})));
  EXPECT_FALSE(must_wait(area, valve(0), swarm({0, -200}, {0, -1000})));
  EXPECT_TRUE(must_wait(area, valve(0), swarm({0, 200}, {0, -1000})));
}

TEST(WaitZone, OtherObstaclesAreNoValve) {
  std::vector<Body> two = valve(0);
  two[1].obstacle = 1;
  EXPECT_FALSE(must_wait(area, two, swarm({0, -200})));
  std::vector<Body> elsewhere = valve(0);
  WaitZone far = area;
  far.centre = {0, -600};
  EXPECT_FALSE(must_wait(far, elsewhere, swarm({0, -600})));
}

TEST(WaitZone, MayBeTurned) {
  WaitZone turned = area;
  turned.width = 1200;
  turned.height = 100;
  EXPECT_FALSE(must_wait(turned, valve(0), swarm({0, -400})));
  turned.heading = radians(90);
  EXPECT_TRUE(must_wait(turned, valve(0), swarm({0, -400})));
}

// The rectangle drawn is the one that counts: just within a corner is in the zone, just beyond is
// not.
TEST(WaitZone, ItsOutlineIsItsBorder) {
  const WaitZone turned{
      .centre = {300, 200}, .width = 500, .height = 80, .heading = radians(30), .min_gap = 120};
  const Polygon outline = zone_outline(turned);
  ASSERT_EQ(outline.outer.size(), 4u);
  for (const Vec2 corner : outline.outer) {
    const Vec2 out = corner - turned.centre;
    EXPECT_NEAR(norm(out), std::hypot(250, 40), 1e-9);
    EXPECT_TRUE(contains(turned, turned.centre + 0.999 * out));
    EXPECT_FALSE(contains(turned, turned.centre + 1.001 * out));
  }
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(distance(outline.outer[k], outline.outer[(k + 1) % 4]), k % 2 ? 80 : 500, 1e-9);
}

}  // namespace
}  // namespace microswarm::navigation
