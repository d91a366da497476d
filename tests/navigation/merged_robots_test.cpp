// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/policies/merged_robots.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace microswarm::navigation {
namespace {

std::uint32_t sum(std::span<const std::uint32_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), 0u);
}

TEST(MergedRobots, JoinsTheSamePlacesAndRemembersWhoIsWhere) {
  const Robots robots{{}, {1, 2, 1, 3, 2, 1}, {5, 5, 5, 5, 5, 6}};
  MergedRobots merged(robots);
  const auto to = merged.merge_coincident();
  EXPECT_EQ(std::vector<std::uint32_t>(to.begin(), to.end()),
            (std::vector<std::uint32_t>{0, 1, 0, 2, 1, 3}));
  EXPECT_EQ(merged.positions().x, (std::vector<float>{1, 2, 3, 1}));
  EXPECT_EQ(sum(merged.counts()), 6u);
  EXPECT_EQ(merged.counts()[1], 2u);
  EXPECT_TRUE(merged.merge_coincident().empty());
  EXPECT_EQ(merged.robots().x, robots.x);
  EXPECT_EQ(merged.robots().y, robots.y);
}

TEST(MergedRobots, ThinsOutToAsManyAsWanted) {
  Robots robots;
  for (int row = 0; row < 25; ++row) {
    for (int column = 0; column < 40; ++column) {
      robots.x.push_back(static_cast<float>(column - 20));
      robots.y.push_back(static_cast<float>(row - 12));
    }
  }
  MergedRobots merged(robots);
  merged.coarsen(64, 0.5);
  EXPECT_LE(merged.positions().size(), 64u);
  EXPECT_GE(merged.positions().size(), 10u);
  EXPECT_EQ(sum(merged.counts()), 1000u);
  EXPECT_EQ(merged.robots().size(), 1000u);
}

TEST(MergedRobots, OfNobody) {
  MergedRobots merged(Robots{});
  EXPECT_TRUE(merged.merge_coincident().empty());
  EXPECT_EQ(merged.robots().size(), 0u);
}

}  // namespace
}  // namespace microswarm::navigation
