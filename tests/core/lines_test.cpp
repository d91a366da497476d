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

TEST(Lines, EndInLfCrLfOrCr) {
  for (const char* text : {"a\nb\n\nc", "a\r\nb\r\n\r\nc\r\n", "a\rb\r\rc\r", "a\rb\n\nc\r\n",
                           "a\r\r\nb\r\r\n\r\r\nc", "sep=;\na\nb\n\nc"}) {
    Lines lines(text, "x.txt");
    for (const char* line : {"a", "b", "", "c"}) EXPECT_EQ(lines.next(), line) << text;
    EXPECT_EQ(lines.number(), text[0] == 's' ? 5 : 4) << text;
    EXPECT_EQ(lines.next(), std::nullopt) << text;
  }
}

TEST(Lines, OfUtf16AreRefused) {
  for (const char* mark : {"\xff\xfe", "\xfe\xff"}) try {
      Lines(std::string(mark) + "1", "x.txt");
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), "x.txt: is a text in UTF-16: save it in UTF-8");
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
