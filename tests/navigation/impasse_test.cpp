// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/impasse.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/hierarchical/hierarchical.hpp"
#include "tests/navigation/late_drive.hpp"

namespace microswarm::navigation {
namespace {

TEST(Impasse, WhoComesNearerLeadsOn) {
  Impasse impasse(5, 300);
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(impasse.update(k, 1000 - 2 * k, true)) << k;
}

// A swarm that wanders comes no nearer than before, though it comes nearer now and then.
TEST(Impasse, BeginsAfterTheTimeWithoutProgress) {
  Impasse impasse(5, 300);
  EXPECT_FALSE(impasse.update(0, 1000, true));
  EXPECT_FALSE(impasse.update(2, 1100, true));
  EXPECT_FALSE(impasse.update(4.9, 999.5, true));
  EXPECT_TRUE(impasse.update(5, 1050, true));
}

TEST(Impasse, EndsWhereTheWayIsShorterByADistanceThatDoubles) {
  Impasse impasse(5, 300);
  impasse.update(0, 1000, true);
  EXPECT_TRUE(impasse.update(5, 1000, true));
  EXPECT_TRUE(impasse.update(50, 1400, true));
  EXPECT_TRUE(impasse.update(60, 701, true));
  EXPECT_TRUE(impasse.update(60.5, 699, false));
  EXPECT_FALSE(impasse.update(61, 699, true));
  EXPECT_FALSE(impasse.update(65.9, 699, true));
  EXPECT_TRUE(impasse.update(66, 699, true));
  EXPECT_TRUE(impasse.update(70, 100, true));
  EXPECT_FALSE(impasse.update(71, 99, true));
}

TEST(Impasse, NeverBeginsWithoutALimit) {
  Impasse impasse(infinity, 300);
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(impasse.update(1e6 * k, 1000, true));
}

// A column of discs that rest leaves one gap, aside of the way: it is passed with the hierarchy's
// clearance.
TEST(Impasse, WhoLeadsKeepsTheClearance) {
  std::vector<Obstacle> column;
  for (int k = 0; k < 8; ++k)
    if (k != 6) column.push_back({DiscShape{50}, Still{{1000, 65.0 + 125 * k}, 0}});
  HierarchicalParams params;
  params.speed = 70;
  params.clearance = 62;
  params.extra_clearance = 0;
  LateDrive<HierarchicalNavigator> drive{.obstacles = column, .params = params};
  drive.run(120);
  EXPECT_TRUE(drive.arrived);
  EXPECT_GT(drive.min_gap, 11);
}

}  // namespace
}  // namespace microswarm::navigation
