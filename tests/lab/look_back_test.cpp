// SPDX-License-Identifier: Apache-2.0
// Decisions of earlier frames.
#include "microswarm/experiment/session/replay.hpp"
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

TEST(LookBack, ShowsWhyItDecided) {
  const Lab lab;
  const std::uint64_t session =
      open(lab, {{"file", lab.file}, {"settings", {"navigator.type=radar"}}});
  TestPage page(lab, session);
  for (int i = 0; i < 12; ++i) page.does({{"do", "step"}});
  page.does({{"do", "seek"}, {"number", 4}});
  const Json frame = page.until("frame", [](const Json& one) { return one["number"] == 4; });
  ASSERT_TRUE(frame.contains("radar"));
  EXPECT_GT(frame["radar"]["sectors"].size(), 0u) << frame["radar"].dump();

  const Reply reply = get(lab, "/api/sessions/" + std::to_string(session) + "/record.h5");
  const auto record = experiment::read_record(lab.folder.with("run.h5", reply.body()));
  EXPECT_FALSE(record.scene.scenario.record.diagnostics);
  EXPECT_EQ(record.diagnostics.radar.size(), 12u);
  EXPECT_EQ(experiment::replay(record).difference, "");
}

}  // namespace
}  // namespace microswarm::lab
