// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/stop.hpp"

#include <gtest/gtest.h>

namespace microswarm {
namespace {

using namespace std::chrono_literals;

TEST(Stop, AnEmptyOneNeverStops) { EXPECT_FALSE(Stop()()); }

TEST(Stop, TheFlagStops) {
  std::atomic<bool> flag = false;
  const Stop stop(&flag);
  EXPECT_FALSE(stop());
  flag = true;
  EXPECT_TRUE(stop());
  EXPECT_TRUE(stop.requested());
  EXPECT_FALSE(stop.expired());
}

TEST(Stop, TheDeadlineStops) {
  EXPECT_TRUE(Stop(0s)());
  EXPECT_TRUE(Stop(-1s).expired());
  EXPECT_FALSE(Stop(1h)());
}

}  // namespace
}  // namespace microswarm
