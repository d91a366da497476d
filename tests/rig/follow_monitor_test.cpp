// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/follow_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::rig {
namespace {

// Of the last steps, those are judged that make up the distance, and no more.
TEST(FollowMonitor, JudgesTheLastStepsOfAtLeastTheDistance) {
  Rng rng(1, Purpose::test);
  FollowMonitor monitor(0.5);
  std::vector<Vec2> steps;  // commanded, followed
  int failed = 0;
  for (int k = 0; k < 2000; ++k) {
    const double commanded = rng.uniform(0.5, 3);
    const double share = std::sin(0.01 * k) * 0.6 + 0.5 + rng.uniform(-0.2, 0.2);
    steps.push_back({commanded, share * commanded});
    Vec2 sum;
    for (auto one = steps.rbegin(); one != steps.rend() && sum.x < 40; ++one) sum += *one;
    const bool follows = sum.x < 40 || sum.y >= 0.5 * sum.x;
    if (std::abs(sum.y - 0.5 * sum.x) > 1e-6) {
      ASSERT_EQ(monitor.take(commanded, steps.back().y, 40), follows) << k;
    } else {
      monitor.take(commanded, steps.back().y, 40);
    }
    ASSERT_NEAR(monitor.commanded(), sum.x, 1e-6) << k;
    ASSERT_NEAR(monitor.followed(), sum.y, 1e-6) << k;
    failed += !follows;
  }
  EXPECT_GT(failed, 200);
  EXPECT_LT(failed, 1800);
}

TEST(FollowMonitor, WithoutACommandThereIsNothingToFollow) {
  FollowMonitor monitor(0.5);
  for (int k = 0; k < 9; ++k) EXPECT_TRUE(monitor.take(1, 0, 10));
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(monitor.take(0, -5, 10));
  EXPECT_EQ(monitor.followed(), 0);
  EXPECT_FALSE(monitor.take(1, 0, 10));
  FollowMonitor off(0);
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(off.take(1, -1, 10));
}

/// What is measured on `stretches` of 10 steps each, of a swarm that goes `share` of each in a
/// direction that is turned by `angle`, with noise of `spread` µm a step.
std::optional<FollowDirection> measured(double share, double angle, double spread, int stretches,
                                        Rng& rng) {
  FollowAngle follow;
  for (int k = 0; k < 10 * stretches; ++k) {
    const Vec2 noise = spread * Vec2{rng.normal(), rng.normal()};
    const Vec2 seen = share * unit_vector(angle) + noise;
    follow.take(1, seen.x, seen.y, 10);
  }
  return follow.direction();
}

TEST(FollowMonitor, MuchMoreThanTheCommandedDistanceIsNoFollowing) {
  FollowMonitor limited(0.25, 2.5), unlimited(0.25);
  for (int k = 0; k < 20; ++k) {
    EXPECT_TRUE(limited.take(2, 4.8, 40));
    EXPECT_TRUE(unlimited.take(2, 5.4, 40));
  }
  bool follows = true;
  for (int k = 0; k < 20; ++k) follows = limited.take(2, 5.4, 40);
  EXPECT_FALSE(follows);
}

TEST(FollowAngle, IsThatOfTheCameraAgainstTheCoils) {
  Rng rng(2, Purpose::test);
  for (const double angle : {-3.0, -0.5, 0.0, 0.2, 2.0})
    for (const double share : {0.3, 1.0}) {
      const auto found = measured(share, angle, 0, 8, rng);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->angle, angle, 1e-9);
      EXPECT_NEAR(found->share, share, 1e-9);
      EXPECT_NEAR(found->sd, 0, 1e-6);
    }
}

// The errors of many measurements are as large as each says.
TEST(FollowAngle, KnowsItsError) {
  Rng rng(3, Purpose::test);
  double squares = 0, told = 0;
  constexpr int trials = 400;
  for (int k = 0; k < trials; ++k) {
    const auto found = measured(0.8, 0.3, 0.5, 12, rng);
    ASSERT_TRUE(found);
    squares += (found->angle - 0.3) * (found->angle - 0.3) / trials;
    told += found->sd * found->sd / trials;
  }
  EXPECT_NEAR(std::sqrt(told / squares), 1, 0.12);
}

TEST(FollowAngle, NeedsFiveStretchesOfMotion) {
  Rng rng(4, Purpose::test);
  EXPECT_FALSE(measured(1, 0.3, 0, 4, rng));
  EXPECT_TRUE(measured(1, 0.3, 0, 5, rng));
  EXPECT_FALSE(measured(0, 0.3, 0, 9, rng));
  FollowAngle still;
  for (int k = 0; k < 100; ++k) still.take(0, 1, 1, 10);
  EXPECT_FALSE(still.direction());
}

}  // namespace
}  // namespace microswarm::rig
