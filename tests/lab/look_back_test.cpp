// SPDX-License-Identifier: Apache-2.0
// Decisions of earlier frames.
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

TEST(LookBack, ShowsWhyItDecided) {
  const Lab lab;
  const std::uint64_t session = open(
      lab, {{"file", lab.file}, {"settings", {"navigator.type=radar", "record.diagnostics=true"}}});
  TestPage page(lab, session);
  for (int i = 0; i < 12; ++i) page.does({{"do", "step"}});
  page.does({{"do", "seek"}, {"number", 4}});
  const Json frame = page.until("frame", [](const Json& one) { return one["number"] == 4; });
  ASSERT_TRUE(frame.contains("radar"));
  EXPECT_GT(frame.at("radar").at("beams").get_binary().size(), 0u);
}

}  // namespace
}  // namespace microswarm::lab
