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

TEST(LookBack, APageThatComesLaterHasTheRegionsToo) {
  const std::filesystem::path gather = std::filesystem::path(MICROSWARM_SOURCE_DIR) /
                                       "scenarios/papers/gather/vascular_network.yaml";
  const Lab lab({}, experiment::read_scenario(gather));
  const std::uint64_t session = open(lab);
  TestPage first(lab, session);
  for (int i = 0; i < 3; ++i) first.does({{"do", "step"}});
  while (!first.latest.contains("aggregation")) ASSERT_FALSE(first.next().is_null());
  first.does({{"do", "seek"}, {"number", 0}});
  TestPage later(lab, session);
  later.until("standing");
  ASSERT_TRUE(later.latest.contains("aggregation"));
  EXPECT_EQ(later.latest["aggregation"], first.latest["aggregation"]);
}

TEST(LookBack, RobotsAreWhereTheyBegin) {
  const std::filesystem::path gather = std::filesystem::path(MICROSWARM_SOURCE_DIR) /
                                       "scenarios/papers/gather/vascular_network.yaml";
  const Lab lab({}, experiment::read_scenario(gather));
  TestPage page(lab, open(lab));
  const Json before = page.until("frame");
  EXPECT_EQ(before["robots"].get_binary().size(), 64u * 8);
  page.does({{"do", "step"}});
  const Json first = page.until(
      "frame", [](const Json& one) { return one["plans"] != 0 || one["frame"]["t_s"] == 0; });
  EXPECT_EQ(first["robots"], before["robots"]);
  EXPECT_NEAR(before["frame"]["x_um"].get<double>(), first["frame"]["x_um"].get<double>(), 1e-9);
}

TEST(LookBack, SteeringAndTheChangesOfARecordAreSaid) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  page.does({{"do", "manual"}, {"on", true}});
  page.does({{"do", "step"}});
  page.does({{"do", "manual"}, {"on", false}});
  page.does({{"do", "set"}, {"key", "goal_tolerance_um"}, {"value", "31"}});
  page.does({{"do", "step"}});
  EXPECT_EQ(page.latest["standing"]["steered"], true);
  const Reply record = get(lab, "/api/sessions/" + std::to_string(session) + "/record.h5");
  const auto file = lab.folder.with("run.h5", record.body());
  TestPage played(lab, open(lab, {{"file", file.string()}}));
  const Json standing = played.until("standing");
  EXPECT_EQ(standing["steered"], true);
  EXPECT_EQ(standing["changes"], Json({"goal_tolerance_um=31"}));
  EXPECT_EQ(played.latest["hello"]["states"][0], "hold");
  EXPECT_EQ(played.latest["hello"]["command"], "microswarm replay " + file.string());
}

}  // namespace
}  // namespace microswarm::lab
