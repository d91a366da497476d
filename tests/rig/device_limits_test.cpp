// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/device_limits.hpp"

#include <gtest/gtest.h>

#include "tests/messages.hpp"

namespace microswarm::rig {
namespace {

std::string taken(DeviceLimits& limits, double t, double scale) {
  actuation::CoilOutput output;
  output.device_scale = scale;
  return limits.take(t, output);
}

TEST(DeviceLimits, AScaleThatIsLowForLongerThanASecondIsAFault) {
  DeviceLimits limits;
  for (double t = 0; t < 10; t += 0.5) EXPECT_EQ(taken(limits, t, 0.1), "") << t;
  for (const double t : {10.0, 10.5, 11.0}) EXPECT_EQ(taken(limits, t, 0.05), "") << t;
  const std::string why = taken(limits, 11.1, 0.05);
  EXPECT_TRUE(test::is_one_line_naming(why, "", {"5", "%"})) << why;
}

TEST(DeviceLimits, WhatRecoversInTimeIsForgotten) {
  DeviceLimits limits;
  for (double t = 0; t < 10; t += 0.9) {
    EXPECT_EQ(taken(limits, t, 0), "") << t;
    EXPECT_EQ(taken(limits, t + 0.8, 0), "") << t;
    EXPECT_EQ(taken(limits, t + 0.85, 0.2), "") << t;
  }
}

TEST(DeviceLimits, NoCurrentIsCalledThat) {
  DeviceLimits limits;
  EXPECT_EQ(taken(limits, 0, 0), "");
  EXPECT_TRUE(test::is_one_line_naming(taken(limits, 2, 0), "", {"no", "current"}));
}

}  // namespace
}  // namespace microswarm::rig
