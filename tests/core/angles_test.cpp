// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/angles.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm {
namespace {

TEST(Angles, WrapStaysInRangeAndKeepsTheDirection) {
  Rng rng(1, Purpose::test);
  for (int i = 0; i < 10'000; ++i) {
    const double a = rng.uniform(-100, 100);
    const double w = wrap(a);
    EXPECT_LE(std::abs(w), pi);
    EXPECT_NEAR(std::cos(w), std::cos(a), 1e-12);
    EXPECT_NEAR(std::sin(w), std::sin(a), 1e-12);
    EXPECT_EQ(wrap(w), w);
  }
}

TEST(Angles, WrapLeavesWhatIsAlreadyWrapped) {
  for (double a : {0.0, 1.0, -1.0, 3.0, -3.0, pi, -pi}) EXPECT_EQ(wrap(a), a);
  EXPECT_NEAR(wrap(3 * pi / 2), -pi / 2, 1e-15);
}

TEST(Angles, TurnIsSymmetricAndTheShorterWay) {
  Rng rng(2, Purpose::test);
  for (int i = 0; i < 10'000; ++i) {
    const double a = rng.uniform(-10, 10), b = rng.uniform(-10, 10);
    EXPECT_EQ(turn_between(a, b), turn_between(b, a));
    EXPECT_GE(turn_between(a, b), 0);
    EXPECT_LE(turn_between(a, b), pi);
    EXPECT_NEAR(std::cos(turn_between(a, b)), std::cos(a - b), 1e-12);
  }
  EXPECT_NEAR(turn_between(radians(179), radians(-179)), radians(2), 1e-12);
}

TEST(Angles, DegreesAndRadiansAreInverse) {
  EXPECT_EQ(radians(180), pi);
  EXPECT_EQ(degrees(pi), 180);
  for (double d = -720; d <= 720; d += 7.5) EXPECT_NEAR(degrees(radians(d)), d, 1e-12);
}

}  // namespace
}  // namespace microswarm
