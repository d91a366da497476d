// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/errors/error.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/version.hpp"

namespace microswarm {
namespace {

TEST(Error, NamesThePlaceAsFarAsItIsKnown) {
  EXPECT_STREQ(InputError("no such coil").what(), "no such coil");
  EXPECT_STREQ(InputError("a.yaml", 12, 9, "bad").what(), "a.yaml:12:9: bad");
  EXPECT_STREQ(InputError("a.yaml", 12, 0, "bad").what(), "a.yaml:12: bad");
  EXPECT_STREQ(InputError("a.yaml", 0, 0, "bad").what(), "a.yaml: bad");
}

TEST(Status, EveryStatusHasItsOwnWord) {
  std::set<std::string_view> words;
  for (int i = 0; i <= static_cast<int>(Status::fault); ++i) {
    const std::string_view word = to_string(static_cast<Status>(i));
    EXPECT_EQ(word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos);
    EXPECT_TRUE(words.insert(word).second) << word;
  }
  EXPECT_EQ(to_string(Status::start_blocked), "start_blocked");
}

TEST(Version, HasThreeParts) {
  EXPECT_EQ(version.find_first_not_of("0123456789."), std::string_view::npos);
  EXPECT_EQ(std::count(version.begin(), version.end(), '.'), 2);
}

}  // namespace
}  // namespace microswarm
