// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/fields/units.hpp"

#include <gtest/gtest.h>

#include <set>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

TEST(Units, EveryUnitHasItsOwnSuffixAndASymbol) {
  std::set<std::string_view> suffixes;
  for (int i = 0; i <= static_cast<int>(Unit::k_per_w); ++i) {
    const Unit unit = static_cast<Unit>(i);
    EXPECT_TRUE(suffixes.insert(unit_suffix(unit)).second) << unit_suffix(unit);
    EXPECT_EQ(unit_symbol(unit).empty(), unit == Unit::none);
  }
  EXPECT_EQ(unit_suffix(Unit::um_per_s), "um_per_s");
  EXPECT_EQ(unit_symbol(Unit::um_per_s), "µm/s");
}

TEST(Units, OnlyAnglesAreShownOtherwiseThanStored) {
  EXPECT_EQ(unit_shown_per_stored(Unit::um), 1);
  EXPECT_EQ(unit_shown_per_stored(Unit::rad), 1);
  EXPECT_DOUBLE_EQ(unit_shown_per_stored(Unit::deg) * pi, 180);
  EXPECT_DOUBLE_EQ(unit_shown_per_stored(Unit::deg_per_s) * pi, 180);
}

}  // namespace
}  // namespace microswarm
