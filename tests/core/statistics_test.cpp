// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/magnitudes.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm {
namespace {

TEST(Statistics, MedianIsTheMiddleOrTheMeanOfTheTwoThere) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median({7, 7}), 7);
  EXPECT_EQ(median({5}), 5);
}

TEST(Statistics, MedianOfNobody) {
  EXPECT_EQ(median({}), 0);
  EXPECT_FALSE(median_if_any({}));
  EXPECT_EQ(median_if_any({2}), 2);
}

TEST(Statistics, QuantilesOccur) {
  EXPECT_EQ(quantile({4, 1, 3, 2}, 0.5), 2);
  EXPECT_EQ(quantile({4, 1, 3, 2}, 0.99), 4);
  EXPECT_EQ(quantile({4, 1, 3, 2}, 0), 1);
}

// Worked by hand from Wilson's formula: 0 of 10 and 10 of 10 mirror each other.
TEST(Statistics, IntervalsOfShares) {
  const ShareInterval none = share_interval(0, 10);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 0.27753, 1e-5);
  const ShareInterval all = share_interval(10, 10);
  EXPECT_NEAR(all.low, 1 - none.high, 1e-12);
  EXPECT_EQ(all.high, 1);
  const ShareInterval half = share_interval(50, 100);
  EXPECT_NEAR(half.low, 0.40383, 1e-5);
  EXPECT_NEAR(half.high, 0.59617, 1e-5);
  EXPECT_EQ(share_interval(0, 0).high, 1);
}

TEST(Median, OfMagnitudesIsTheSame) {
  Rng rng(3, Purpose::test);
  EXPECT_EQ(median_of_magnitudes({}), 0);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> values(1 + rng.below(60));
    const double octaves = rng.uniform(0, 80);
    for (double& v : values) v = std::exp2(rng.uniform(-octaves, 0.1 * octaves));
    if (trial % 3 == 0) std::fill_n(values.begin(), values.size() / 2, trial % 2 ? 0.0 : 0.75);
    EXPECT_EQ(median_of_magnitudes(values), median(values)) << trial;
  }
}

}  // namespace
}  // namespace microswarm
