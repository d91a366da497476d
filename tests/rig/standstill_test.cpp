// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/standstill.hpp"

#include <gtest/gtest.h>

#include "tests/messages.hpp"

namespace microswarm::rig {
namespace {

constexpr double for_ever = 1e9;  // [s] that a pass may take

TEST(Standstill, ASuspensionBeyondWhatIsAllowedIsNeverForgotten) {
  double asleep = 100;  // before it was made
  Standstill standstill(0.5, [&] { return asleep; });
  EXPECT_EQ(standstill.pass(for_ever), "");
  asleep = 100.4;
  EXPECT_EQ(standstill.pass(for_ever), "");
  asleep = 100.8;  // in two parts
  EXPECT_TRUE(test::is_one_line_naming(standstill.pass(for_ever), "", {"suspended", "0.8"}));
  EXPECT_NE(standstill.pass(for_ever), "");
}

TEST(Standstill, TimeBeyondWhatWasMeantIsOne) {
  Standstill standstill(0.5, [] { return 0.0; });
  EXPECT_EQ(standstill.pass(for_ever), "");
  EXPECT_TRUE(test::is_one_line_naming(standstill.pass(-3), "", {"stood", "3"}));
  EXPECT_EQ(standstill.pass(for_ever), "") << "each pass is measured from the one before";
}

}  // namespace
}  // namespace microswarm::rig
