// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/follower.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/following/path_follower.hpp"
#include "microswarm/swarm/body/unicycle.hpp"

namespace microswarm::navigation {
namespace {

const std::vector<Vec2> short_corner{{0, 0}, {100, 0}, {100, 100}};

TEST(Follower, PlacesGoForwardOnly) {
  PathPosition position = nearest_position(short_corner, {60, 5}, {});
  EXPECT_EQ(position.piece, 0U);
  EXPECT_NEAR(position.share, 0.6, 1e-12);
  position = nearest_position(short_corner, {20, 0}, position);
  EXPECT_NEAR(position.share, 0.6, 1e-12);
}

TEST(Follower, PointAheadRunsAroundTheCornerAndEndsAtTheEnd) {
  EXPECT_EQ(point_ahead(short_corner, {0, 0.5}, 75), (Vec2{100, 25}));
  EXPECT_EQ(point_ahead(short_corner, {0, 0}, 1e9), (Vec2{100, 100}));
  EXPECT_NEAR(remaining(short_corner, {0, 0.5}), 150, 1e-12);
}

TEST(Follower, APathOfOnePointIsHeldOn) {
  const std::vector<Vec2> point{{3, 4}};
  PathPosition position;
  EXPECT_EQ(point_ahead(point, position, 10), (Vec2{3, 4}));
  EXPECT_EQ(remaining(point, position), 0);
}

// On the line it heads into the flow so far that it moves along the line.
TEST(Follower, HeadsIntoAFlowAcrossThePath) {
  const std::vector<Vec2> path{{0, 0}, {1000, 0}};
  constexpr double speed = 60;
  for (const double across : {-40.0, -20.0, 20.0, 40.0}) {
    PathPosition position;
    const Command command = pursue_in_flow(path, position, {{100, 0}, 0}, 80, speed, {5, across});
    const Vec2 moved = speed * unit_vector(command.heading) + Vec2{5, across};
    EXPECT_NEAR(moved.y, 0, 1e-9) << across;
    EXPECT_GT(moved.x, 0) << across;
  }
}

TEST(Follower, ReachesTheEndFromAnyHeading) {
  for (int k = 0; k < 16; ++k) {
    Pose2 pose{{0, 10}, wrap(k * pi / 8)};
    PathPosition position;
    double worst = 0;
    for (int i = 0; i < 400 && distance(pose.position, short_corner.back()) > 5; ++i) {
      pose = unicycle_step(pose, pursue(short_corner, position, pose, 20, 30), 3, 0.05);
      double off = 1e9;
      for (std::size_t j = 0; j + 1 < short_corner.size(); ++j) {
        const PathPosition p = nearest_position(
            std::vector<Vec2>{short_corner[j], short_corner[j + 1]}, pose.position, {});
        off = std::min(
            off, distance(pose.position,
                          short_corner[j] + p.share * (short_corner[j + 1] - short_corner[j])));
      }
      worst = std::max(worst, off);
    }
    EXPECT_LE(distance(pose.position, short_corner.back()), 5) << "heading " << k * 22.5;
    EXPECT_LT(worst, 25) << "heading " << k * 22.5;
  }
}

}  // namespace
}  // namespace microswarm::navigation
