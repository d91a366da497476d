// SPDX-License-Identifier: Apache-2.0
#include "microswarm/contracts/plan.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::planning {
namespace {

const std::vector<Vec2> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(PathLength, IsTheSumOfItsEdges) {
  EXPECT_EQ(path_length(square), 30);
  EXPECT_EQ(path_length(std::vector<Vec2>{{3, 4}}), 0);
  EXPECT_EQ(path_length(std::vector<Vec2>{}), 0);
}

TEST(PathTurning, CountsTheTurnOutOfTheStartOnlyWhenAHeadingIsGiven) {
  EXPECT_DOUBLE_EQ(path_turning(square), pi);
  EXPECT_DOUBLE_EQ(path_turning(square, 0), pi);
  EXPECT_DOUBLE_EQ(path_turning(square, pi / 2), 1.5 * pi);
  EXPECT_EQ(path_turning(std::vector<Vec2>{{3, 4}}, 1), 0);
}

TEST(PathTurning, TakesTheShortWayRoundAtPi) {
  const std::vector<Vec2> leftwards{{0, 0}, {-10, 1}, {-20, 0}};
  EXPECT_NEAR(path_turning(leftwards), 2 * std::atan(0.1), 1e-12);
  EXPECT_NEAR(path_turning(leftwards, -pi), 3 * std::atan(0.1), 1e-12);
}

TEST(PathTurning, PassesOverRepeatedPoints) {
  EXPECT_EQ(path_turning(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 0}, {2, 0}}), 0);
}

TEST(PathTo, RunsFromTheRoot) {
  const std::vector<TreeNode> tree{
      {{0, 0}, 0, 0, 0}, {{1, 0}, 0, 1, 0}, {{5, 5}, 0, 1, 0}, {{2, 0}, 0, 2, 1}};
  EXPECT_EQ(path_to(tree, 3), (std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}}));
  EXPECT_EQ(path_to(tree, 0), (std::vector<Vec2>{{0, 0}}));
}

}  // namespace
}  // namespace microswarm::planning
