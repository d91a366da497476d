// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/lines.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"

namespace microswarm {
namespace {

using Pieces = std::vector<std::string_view>;

TEST(Lines, EndsAndAByteOrderMarkAreLeftOut) {
  Lines lines("\xef\xbb\xbfone\r\n\n three", "x.txt");
  EXPECT_EQ(lines.next(), "one");
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), " three");
  EXPECT_EQ(lines.number(), 3);
  EXPECT_EQ(lines.next(), std::nullopt);
  try {
    lines.fail("why");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "x.txt:3: why");
  }
}

TEST(Lines, PiecesAndWords) {
  EXPECT_EQ(split(" 1, 2,,3 ", ','), (Pieces{"1", "2", "", "3"}));
  EXPECT_EQ(split("", ','), (Pieces{""}));
  EXPECT_EQ(split("1,", ','), (Pieces{"1", ""}));
  EXPECT_EQ(words(" 1\t2  3\r"), (Pieces{"1", "2", "3"}));
  EXPECT_EQ(words("  "), Pieces{});
  EXPECT_EQ(trimmed(" \t a b \r"), "a b");
}

}  // namespace
}  // namespace microswarm
