// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/common/detection.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::planning {
namespace {

scenes::RawWorld open_world() {
  scenes::RawWorld world;
  world.bounds = {{-1000, -1000}, {1000, 1000}};
  return world;
}

TEST(Detect, NothingInSightMeansTheFullStep) {
  const Detection seen = detect(open_world().snapshot(), {{0, 0}, 100}, 0.2);
  EXPECT_EQ(seen.w1, 0);
  EXPECT_EQ(seen.w2, 0);
  EXPECT_EQ(seen.rho, 1);
}

TEST(Detect, HalfPlaneAtADistance) {
  scenes::RawWorld world = open_world();
  world.walls.push_back(scenes::rectangle({{50, -500}, {900, 500}}));
  const Detection seen = detect(world.snapshot(), {{0, 0}, 100}, 0.2);
  const double segment = 1e4 * (pi / 3 - std::sqrt(3.0) / 4);  // r² (acos ½ − ½ √(1 − ¼))
  EXPECT_NEAR(seen.w1, segment / (pi * 1e4), 1e-12);
  EXPECT_NEAR(seen.w2, 1 - 2 * 50 / (1 * 200.0), 1e-12);
  EXPECT_NEAR(seen.rho, 0.5 + 0.5 * (1 - (seen.w1 + seen.w2)), 1e-15);
}

TEST(Detect, TakesTheMeanOverObstaclesAndCountsOverlapsOnce) {
  scenes::RawWorld world = open_world();
  world.movers = {{{60, 0}, 20}, {{-70, 0}, 10}, {{60, 0}, 5}};
  const Detection seen = detect(world.snapshot(), {{0, 0}, 100}, 0.2);
  EXPECT_NEAR(seen.w1, (400.0 + 100.0) / 1e4, 1e-12);
  EXPECT_NEAR(seen.w2, 1 - (40.0 + 60.0 + 55.0) / (3 * 100), 1e-12);
}

TEST(Detect, CentreInAnObstacleIsAsNearAsCanBe) {
  scenes::RawWorld world = open_world();
  world.discs = {{{0, 0}, 300}};
  const Detection seen = detect(world.snapshot(), {{10, 0}, 100}, 0.2);
  EXPECT_NEAR(seen.w1, 1, 1e-12);
  EXPECT_EQ(seen.w2, 1);
  EXPECT_EQ(seen.rho, 0.2);  // the floor
}

TEST(Detect, CircleWithoutExtentSeesNothing) {
  scenes::RawWorld world = open_world();
  world.discs = {{{0, 0}, 300}};
  EXPECT_EQ(detect(world.snapshot(), {{0, 0}, 0}, 0.2).rho, 1);
}

}  // namespace
}  // namespace microswarm::planning
