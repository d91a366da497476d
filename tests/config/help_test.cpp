// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/help.hpp"

#include <gtest/gtest.h>

#include "tests/config/sample.hpp"

namespace microswarm::sample {
namespace {

TEST(Help, IsATable) {
  EXPECT_EQ(help_text<Obstacle>(),
            R"(key                    unit  default   allowed       meaning
shape                        required  a type below  What it is.
  type: disc
    radius_um          µm    required  0.001..1e6    Radius.
  type: fan
    opening_deg        °     30        0..360        Angle at its tip.
    turning_deg_per_s  °/s   0                       How fast it turns.
  type: nothing
way_um                 µm    []        -1e6..1e6     Where it goes.
)");
}

TEST(Help, ShowsTheDefaultsOfTheOuterStruct) {
  const std::string text = help_text<Scene>();
  EXPECT_NE(text.find("  step_um                µm    25 "), std::string::npos) << text;
  EXPECT_NE(text.find("limit_s                  s     none "), std::string::npos) << text;
  EXPECT_NE(text.find("noisy                          false       true | false"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace microswarm::sample
