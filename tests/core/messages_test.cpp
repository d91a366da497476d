// SPDX-License-Identifier: Apache-2.0
// What the tests of complaints rest on.
#include "tests/messages.hpp"

#include <gtest/gtest.h>

namespace microswarm::test {
namespace {

TEST(Messages, APartOfAWordOrNumberIsNotNamed) {
  EXPECT_TRUE(names("radius_um is -3 µm, allowed 0.001..1e5 µm", "radius_um"));
  EXPECT_TRUE(names("radius_um is -3 µm, allowed 0.001..1e5 µm", "-3 µm"));
  EXPECT_FALSE(names("radius_um is -3 µm", "radius"));
  EXPECT_FALSE(names("wall 12", "wall 1"));
  EXPECT_FALSE(names("112 µm", "12 µm"));
  EXPECT_FALSE(names("is 2.5 µm", "2"));
  EXPECT_FALSE(names("is 2.5 µm", "5 µm"));
  EXPECT_TRUE(names("allowed 0..8.", "8"));
  EXPECT_TRUE(names("wall 12 and wall 1", "wall 1"));
}

TEST(Messages, OneLineWithItsPlaceAndAReason) {
  const std::string line = "a.yaml:3:1: unknown key 'gird', did you mean 'grid'?";
  EXPECT_TRUE(is_one_line_naming(line, "a.yaml:3:1", {"gird", "grid"}));
  EXPECT_TRUE(is_one_line_naming(line + "\n", "a.yaml:3:1", {"gird"})) << "as a program prints it";
  EXPECT_FALSE(is_one_line_naming(line + "\nb.yaml: more", "a.yaml:3:1", {"gird"}));
  EXPECT_FALSE(is_one_line_naming(line, "a.yaml:3", {"gird"}));
  EXPECT_FALSE(is_one_line_naming(line, "a.yaml:3:1", {"a.yaml"})) << "only the place has it";
  EXPECT_FALSE(is_one_line_naming(line, "a.yaml:3:1", {"gird", "key 'grid'"}));
  EXPECT_FALSE(is_one_line_naming("a.yaml: ", "a.yaml", {}));
  EXPECT_FALSE(is_one_line_naming("", "", {}));
}

TEST(Messages, AWholeLineIsCompared) {
  EXPECT_TRUE(is("a.csv: empty file\n", Complaint("empty file").in("a.csv")));
  EXPECT_FALSE(is("a.csv: empty file.", Complaint("empty file").in("a.csv")));
  EXPECT_TRUE(is("a.csv: 3 fields, 4 expected", naming("", {"3", "4"}).in("a.csv")));
  EXPECT_FALSE(is("b.csv: 3 fields, 4 expected", naming("", {"3", "4"}).in("a.csv")));
}

}  // namespace
}  // namespace microswarm::test
