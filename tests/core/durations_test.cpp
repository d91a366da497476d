// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/durations.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/core/maths/statistics.hpp"

namespace microswarm {
namespace {

TEST(Durations, QuantilesAreThoseOfTheListWithinOnePercent) {
  Rng rng(4, Purpose::scene);
  std::vector<double> list;
  Durations durations;
  for (int i = 0; i < 5000; ++i) {
    list.push_back(std::pow(10, rng.uniform(-5.9, 2.9)));
    durations.add(list.back());
  }
  EXPECT_EQ(durations.count(), list.size());
  for (const double q : {0.0, 0.01, 0.5, 0.95, 0.99, 1.0}) {
    const double exact = quantile(list, q);
    EXPECT_GE(durations.quantile(q), exact * (1 - 1e-12)) << q;
    EXPECT_LE(durations.quantile(q), 1.0101 * exact) << q;
  }
}

TEST(Durations, NoneVeryShortAndVeryLong) {
  Durations durations;
  EXPECT_EQ(durations.quantile(0.5), 0);
  durations.add(0);
  EXPECT_LE(durations.quantile(0.5), 1.01e-6);
  durations.add(1e9);
  EXPECT_EQ(durations.count(), 2u);
  EXPECT_GE(durations.quantile(1), 900);
  EXPECT_LE(durations.quantile(1), 1e9);
}

}  // namespace
}  // namespace microswarm
