// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/statistics.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace microswarm
