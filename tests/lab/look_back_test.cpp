// SPDX-License-Identifier: Apache-2.0
// Decisions of earlier frames.
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

/// The message of frame 4 of a run that has twelve.
Json earlier_frame(const std::vector<std::string>& settings) {
  const Lab lab;
  TestPage page(lab, open(lab, {{"file", lab.file}, {"settings", settings}}));
  for (int i = 0; i < 12; ++i) page.does({{"do", "step"}});
  page.does({{"do", "seek"}, {"number", 4}});
  return page.until("frame", [](const Json& frame) { return frame["number"] == 4; });
}

TEST(LookBack, ShowsWhyItDecided) {
  const Json frame = earlier_frame({"navigator.type=radar"});
  ASSERT_TRUE(frame.contains("radar"));
  EXPECT_GT(frame["radar"]["sectors"].size(), 0u) << frame["radar"].dump();
}

TEST(LookBack, ShowsNothingWhereNoneIsKept) {
  const Json frame = earlier_frame({"navigator.type=radar", "record.diagnostics=false"});
  EXPECT_FALSE(frame.is_null());
  EXPECT_FALSE(frame.contains("radar"));
}

}  // namespace
}  // namespace microswarm::lab
