// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/aim.hpp"

#include <gtest/gtest.h>

#include "tests/navigation/room.hpp"

namespace microswarm::navigation {
namespace {

// Whoever comes within the aim's tolerance is within the goal's.
TEST(Aim, ItsToleranceIsWhatIsLeftOfTheGoals) {
  const Snapshot world = room_with();
  int moved = 0;
  for (const double y : {40.0, 55.0, 70.0, 85.0, 100.0, 120.0}) {
    const Vec2 goal{1000, y};
    const Aim aim = aim_at(world, goal, 30, 50, 90);
    EXPECT_DOUBLE_EQ(aim.tolerance + distance(aim.position, goal), 30) << y;
    EXPECT_GE(aim.tolerance, (1 - aim_share) * 30 - 1e-9) << y;
    EXPECT_DOUBLE_EQ(aim.clearance, world.map().clearance(aim.position)) << y;
    moved += aim.position != goal;
  }
  EXPECT_EQ(moved, 4);
}

}  // namespace
}  // namespace microswarm::navigation
