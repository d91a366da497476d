// SPDX-License-Identifier: Apache-2.0
#include "lab/files/download.hpp"

#include <gtest/gtest.h>

#include "tests/files.hpp"

namespace microswarm::lab {
namespace {

TEST(Renamed, ErrorsKeepTheirIssues) {
  Issues issues;
  issues.add(Issue{{"tick_s"}, "is 0", "/tmp/x/upload-1.yaml:1:9", "0", "above 0"});
  issues.add(Issue{{"map"}, "/tmp/x/upload-1.yaml names /tmp/x/upload-1.yaml", "", "7", ""});
  const Issues renamed = test::issues_of(
      [&] { throw_renamed(InputError(issues), "/tmp/x/upload-1.yaml", "mine.yaml"); });
  ASSERT_EQ(renamed.size(), 2u);
  EXPECT_EQ(renamed[0].keys, std::vector<std::string>{"tick_s"});
  EXPECT_EQ(renamed[0].text, "is 0");
  EXPECT_EQ(renamed[0].location, "mine.yaml:1:9");
  EXPECT_EQ(renamed[0].value, "0");
  EXPECT_EQ(renamed[0].limit, "above 0");
  EXPECT_EQ(renamed[1].keys, std::vector<std::string>{"map"});
  EXPECT_EQ(renamed[1].text, "mine.yaml names mine.yaml");
  EXPECT_EQ(renamed[1].value, "7");
}

}  // namespace
}  // namespace microswarm::lab
