// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/crowd.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace microswarm {
namespace {

std::uint32_t sum(std::span<const std::uint32_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), 0u);
}

TEST(Crowd, JoinsTheSamePlacesAndRemembersWhoIsWhere) {
  const Robots robots{{}, {1, 2, 1, 3, 2, 1}, {5, 5, 5, 5, 5, 6}};
  Crowd crowd(robots);
  const auto to = crowd.join();
  EXPECT_EQ(std::vector<std::uint32_t>(to.begin(), to.end()),
            (std::vector<std::uint32_t>{0, 1, 0, 2, 1, 3}));
  EXPECT_EQ(crowd.places().x, (std::vector<float>{1, 2, 3, 1}));
  EXPECT_EQ(sum(crowd.counts()), 6u);
  EXPECT_EQ(crowd.counts()[1], 2u);
  EXPECT_TRUE(crowd.join().empty());
  EXPECT_EQ(crowd.robots().x, robots.x);
  EXPECT_EQ(crowd.robots().y, robots.y);
}

TEST(Crowd, ThinsOutToAsManyAsWanted) {
  Robots robots;
  for (int row = 0; row < 25; ++row) {
    for (int column = 0; column < 40; ++column) {
      robots.x.push_back(static_cast<float>(column - 20));
      robots.y.push_back(static_cast<float>(row - 12));
    }
  }
  Crowd crowd(robots);
  crowd.thin_out(64, 0.5);
  EXPECT_LE(crowd.places().size(), 64u);
  EXPECT_GE(crowd.places().size(), 10u);
  EXPECT_EQ(sum(crowd.counts()), 1000u);
  EXPECT_EQ(crowd.robots().size(), 1000u);
}

TEST(Crowd, OfNobody) {
  Crowd crowd(Robots{});
  EXPECT_TRUE(crowd.join().empty());
  EXPECT_EQ(crowd.robots().size(), 0u);
}

}  // namespace
}  // namespace microswarm
