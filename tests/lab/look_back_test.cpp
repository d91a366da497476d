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

/// The message of frame 4 of a run that has twelve.
Json earlier_frame(TestPage& page) {
  for (int i = 0; i < 12; ++i) page.does({{"do", "step"}});
  page.does({{"do", "seek"}, {"number", 4}});
  return page.until("frame", [](const Json& frame) { return frame["number"] == 4; });
}

TEST(LookBack, ShowsWhyARunDecidedWhoseRecordKeepsNothing) {
  const Lab lab;
  const std::uint64_t session =
      open(lab, {{"file", lab.file}, {"settings", {"navigator.type=radar"}}});
  TestPage page(lab, session);
  const Json frame = earlier_frame(page);
  ASSERT_TRUE(frame.contains("radar"));
  EXPECT_NEAR(frame["radar"]["centre"][0].get<double>(), frame["frame"]["x_um"].get<double>(), 40);
  const Reply record = get(lab, "/api/sessions/" + std::to_string(session) + "/record.h5");
  const auto file = lab.folder.with("run.h5", record.body());
  EXPECT_TRUE(experiment::read_record(file).diagnostics.empty());
}

TEST(LookBack, ValuesAndMetricsAreThoseOfTheTime) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  for (int i = 0; i < 6; ++i) page.does({{"do", "step"}});
  page.does({{"do", "set"}, {"key", "goal_tolerance_um"}, {"value", "31"}});
  const Json before = page.latest["hello"]["scenario"]["goal_tolerance_um"];
  const Json frame = earlier_frame(page);
  const Json time = frame["frame"]["t_s"];
  page.until("standing", [](const Json& one) { return one["looks_back"] == true; });
  EXPECT_EQ(page.latest["scenario"]["scenario"]["goal_tolerance_um"], before);
  EXPECT_EQ(page.latest["standing"]["metrics"]["time_s"], time);
  EXPECT_EQ(page.latest["standing"]["frames"], 18);
  TestPage later(lab, session);
  later.until("standing");
  EXPECT_EQ(later.latest["scenario"]["scenario"]["goal_tolerance_um"], before);
  page.does({{"do", "live"}});
  page.until("standing", [](const Json& one) { return one["looks_back"] == false; });
  EXPECT_EQ(page.latest["scenario"]["scenario"]["goal_tolerance_um"], 31);
  EXPECT_GT(page.latest["standing"]["metrics"]["time_s"], time);
}

TEST(LookBack, ARecordShowsTheValuesOfTheTimeToo) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  for (int i = 0; i < 3; ++i) page.does({{"do", "step"}});
  page.does({{"do", "set"}, {"key", "goal_tolerance_um"}, {"value", "31"}});
  for (int i = 0; i < 3; ++i) page.does({{"do", "step"}});
  const Reply record = get(lab, "/api/sessions/" + std::to_string(session) + "/record.h5");
  const auto file = lab.folder.with("run.h5", record.body());
  TestPage played(lab, open(lab, {{"file", file.string()}}));
  const auto tolerance_at = [&](int number) {
    played.does({{"do", "seek"}, {"number", number}});
    played.until("frame", [&](const Json& frame) { return frame["number"] == number; });
    return played.latest["scenario"]["scenario"]["goal_tolerance_um"];
  };
  const Json before = played.until("hello")["scenario"]["goal_tolerance_um"];
  EXPECT_EQ(tolerance_at(5), 31);
  EXPECT_EQ(tolerance_at(1), before);
}

/// The rows of a session's record, as text.
std::string frames_of(const Lab& lab, std::uint64_t session) {
  return get(lab, "/api/sessions/" + std::to_string(session) + "/frames.csv").body();
}

TEST(LookBack, ABranchIsTheRunUpToAPastFrame) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  for (int i = 0; i < 3; ++i) page.does({{"do", "step"}});
  page.does({{"do", "set"}, {"key", "goal_tolerance_um"}, {"value", "31"}});
  page.does({{"do", "manual"}, {"on", true}});
  page.does({{"do", "steer"}, {"heading", 1}, {"speed", 20}});
  for (int i = 0; i < 3; ++i) page.does({{"do", "step"}});
  page.does({{"do", "manual"}, {"on", false}});
  for (int i = 0; i < 14; ++i) page.does({{"do", "step"}});

  const std::uint64_t same = open(lab, {{"branch", session}, {"frame", 8}});
  TestPage copy(lab, same);
  EXPECT_EQ(copy.until("frame")["number"], 8);
  const Json standing = copy.until("standing");
  EXPECT_EQ(standing["frames"], 9);
  EXPECT_EQ(standing["steered"], true);
  EXPECT_EQ(standing["changes"], Json({"goal_tolerance_um=31"}));
  copy.does({{"do", "seek"}, {"number", 2}});
  const Json past = copy.until("frame", [](const Json& one) { return one["number"] == 2; });
  EXPECT_TRUE(past.contains("hierarchical"));
  EXPECT_EQ(
      copy.until("standing",
                 [](const Json& one) { return one["looks_back"] == true; })["metrics"]["time_s"],
      past["frame"]["t_s"]);
  for (int i = 0; i < 11; ++i) copy.does({{"do", "step"}});
  EXPECT_EQ(frames_of(lab, same), frames_of(lab, session));

  const std::uint64_t other =
      open(lab, {{"branch", session}, {"frame", 8}, {"changes", {"goal_um=[150, 400]"}}});
  TestPage changed(lab, other);
  const Json changes = changed.until("standing")["changes"];
  EXPECT_EQ(changes, Json({"goal_tolerance_um=31", "goal_um=[150, 400]"}));
  for (int i = 0; i < 11; ++i) changed.does({{"do", "step"}});
  EXPECT_NE(frames_of(lab, other), frames_of(lab, session));
  EXPECT_EQ(frames_of(lab, other).substr(0, 500), frames_of(lab, session).substr(0, 500));

  changed.does({{"do", "restart"}, {"settings", Json::array()}});
  EXPECT_EQ(changed.latest["standing"]["frames"], 0);
}

TEST(LookBack, ABranchThatCannotBeIsRefusedInALine) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  const auto refused = [&](const Json& body) {
    const Reply reply = ask(lab, http::verb::post, "/api/sessions", body.dump());
    EXPECT_EQ(reply.result(), http::status::bad_request) << body;
    return Json::parse(reply.body())["error"].get<std::string>();
  };
  EXPECT_NE(refused({{"branch", session}, {"frame", 3}}).find("the run has 0"), std::string::npos);
  EXPECT_NE(refused({{"branch", 77}, {"frame", 0}}).find("no such session"), std::string::npos);
  TestPage page(lab, session);
  page.does({{"do", "step"}});
  EXPECT_NE(
      refused({{"branch", session}, {"frame", 0}, {"changes", {"goal_um=far"}}}).find("goal_um"),
      std::string::npos);
}

TEST(Past, KeepsWithinItsMemory) {
  constexpr std::size_t bytes = 100'000;
  Past past(bytes);
  experiment::Tick tick;
  tick.diagnostics =
      Lazy<Diagnostics>([] { return RadarDiagnostics{.beams = std::vector<RadarBeam>(120)}; });
  for (int i = 0; i < 10'000; ++i) {
    tick.frame.t = 0.1 * i;
    past.add(tick, {.time = tick.frame.t}, false);
  }
  const auto& rows = past.diagnostics().radar;
  EXPECT_GT(past.period(), 1);
  EXPECT_LE(rows.size() * (sizeof(rows[0]) + 120 * sizeof(RadarBeam)), 1.2 * bytes);
  EXPECT_GT(rows.size(), 8);
  EXPECT_EQ(rows.front().t, 0);
  EXPECT_NEAR(rows[1].t - rows[0].t, 0.1 * static_cast<double>(past.period()), 1e-9);
  for (const std::uint64_t frame : {0, 17, 5'000, 9'999}) {
    const double time = past.metrics(frame)->time;
    EXPECT_LE(time, 0.1 * static_cast<double>(frame) + 1e-9);
    EXPECT_GE(time, 0.1 * static_cast<double>(frame) - 0.5);
  }
}

TEST(Past, KeepsATreeOnceAndCountsIt) {
  Past past;
  experiment::Tick tick;
  AggregationDiagnostics plan;
  std::size_t before = 0;
  for (int i = 0; i < 6; ++i) {
    plan.nodes.resize(i < 3 ? 1000 : 2000);
    plan.mean_distance = i;
    tick.frame.t = i;
    tick.diagnostics = Lazy<Diagnostics>([&plan] { return plan; });
    past.add(tick, {}, false);
    const bool is_new = i == 0 || i == 3;
    EXPECT_EQ(past.bytes() - before > 1000 * sizeof(AggregationNode), is_new) << i;
    EXPECT_EQ(!past.diagnostics().aggregation.back().shown.nodes.empty(), is_new) << i;
    before = past.bytes();
  }
  EXPECT_EQ(std::get<AggregationDiagnostics>(past.diagnostics().at(2)).nodes.size(), 1000u);
  EXPECT_EQ(std::get<AggregationDiagnostics>(past.diagnostics().at(5)), plan);
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
