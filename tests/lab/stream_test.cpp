// SPDX-License-Identifier: Apache-2.0
#include "lab/stream/stream.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/experiment/scenes.hpp"

namespace microswarm::lab {
namespace {

using Json = nlohmann::json;

Json decoded(const MessagePtr& message) { return Json::from_cbor(message->bytes); }

template <class T>
std::vector<T> numbers(const Json& bytes) {
  const auto& binary = bytes.get_binary();
  std::vector<T> values(binary.size() / sizeof(T));
  std::memcpy(values.data(), binary.data(), binary.size());
  return values;
}

TEST(Stream, HelloHasScenarioMapAndCommand) {
  const experiment::Session session(experiment::open_experiment(experiment::small_flight(), {}));
  const MessagePtr message = hello_message(session, {.file = "a b/it's.yaml",
                                                     .rig = "rig.yaml",
                                                     .settings = {"goal_um=[1, 2]"},
                                                     .rig_settings = {"drive_rate_hz=100"}});
  EXPECT_EQ(message->kind, Message::Kind::hello);
  const Json hello = decoded(message);
  EXPECT_EQ(hello["type"], "hello");
  EXPECT_EQ(hello["playback"], false);
  EXPECT_EQ(hello["command"],
            "microswarm run 'a b/it'\\''s.yaml' --rig rig.yaml --set 'goal_um=[1, 2]' --set-rig "
            "drive_rate_hz=100");
  EXPECT_EQ(hello["settings"], Json({"goal_um=[1, 2]"}));
  EXPECT_EQ(hello["scenario"]["goal_um"][0], experiment::small_flight().goal->x);
  EXPECT_EQ(hello["map"]["hi"][0], session.map().bounds().hi.x);
  EXPECT_FALSE(hello["changeable"].empty());
  EXPECT_EQ(command_line({.file = "run.h5"}, true), "microswarm replay run.h5");
}

TEST(Stream, ClearanceIsThatOfTheMapInAtMostSoManyCells) {
  const experiment::Session session(experiment::open_experiment(experiment::small_flight(), {}));
  const Map& map = session.map();
  const Json json = decoded(clearance_message(map));
  const double cell = json["cell"];
  const int columns = json["columns"], rows = json["rows"];
  EXPECT_LE(columns * rows, 40'000);
  EXPECT_GE(columns * cell, map.bounds().width());
  EXPECT_GE(rows * cell, map.bounds().height());
  const auto values = numbers<float>(json["values"]);
  ASSERT_EQ(values.size(), static_cast<std::size_t>(columns * rows));
  for (const auto& [column, row] : {std::pair{0, 0}, {columns / 2, rows / 3}, {columns - 2, 1}}) {
    const Vec2 p = map.bounds().lo + Vec2{(column + 0.5) * cell, (row + 0.5) * cell};
    const auto at = static_cast<std::size_t>(row * columns + column);
    EXPECT_EQ(values[at], static_cast<float>(map.clearance(p)));
  }
}

TEST(Stream, AFrameIsWhatTheSessionShows) {
  experiment::Session session(experiment::open_experiment(experiment::small_flight(), {}));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(session.step());
  const experiment::SessionView view = session.view();
  const MessagePtr message = frame_message(view, session.diagnostics());
  EXPECT_EQ(message->kind, Message::Kind::frame);
  const Json frame = decoded(message);
  EXPECT_EQ(frame["number"], view.number);
  EXPECT_EQ(frame["frame"]["t_s"], view.frame.t);
  const auto path = numbers<float>(frame["path"]);
  ASSERT_EQ(path.size(), 2 * view.path.size());
  for (std::size_t i = 0; i < view.path.size(); ++i) {
    EXPECT_EQ(path[2 * i], static_cast<float>(view.path[i].x));
    EXPECT_EQ(path[2 * i + 1], static_cast<float>(view.path[i].y));
  }
  const auto discs = numbers<float>(frame["bodies"]["discs"]);
  ASSERT_EQ(discs.size(), 4 * view.bodies.size());
  EXPECT_EQ(discs[2], static_cast<float>(std::get<Disc>(view.bodies[0].shape).radius));
  const Json plan = decoded(plan_message(view));
  EXPECT_EQ(numbers<float>(plan["nodes"]).size(), 2 * view.tree.size());
  EXPECT_EQ(numbers<std::uint32_t>(plan["parents"]).size(), view.tree.size());
}

TEST(Stream, ARecordShowsTheDiagnosticsThatItKeeps) {
  const auto file =
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios/papers/radar/twelve.yaml";
  for (const auto& [navigator, key] :
       {std::pair{"radar", "radar"}, {"safe_interval", "predicted"}}) {
    const auto live = experiment::open_session(file, {"record.diagnostics=true", "time_limit_s=1",
                                                      std::string("navigator.type=") + navigator});
    std::vector<Json> shown;
    while (live->step()) shown.push_back(decoded(frame_message(live->view(), live->diagnostics())));
    EXPECT_TRUE(shown[0].contains(key));
    experiment::Session playback(live->record());
    for (const Json& frame : shown) {
      ASSERT_TRUE(playback.step());
      const Json again = decoded(frame_message(playback.view(), playback.diagnostics()));
      ASSERT_EQ(again[key], frame[key]);
    }
  }
}

TEST(Stream, DecisionsAreWholeInAFrame) {
  experiment::SessionView view;
  Json predicted = decoded(frame_message(
      view, PredictiveDiagnostics{.bodies = {{.body = 3,
                                              .t = 1,
                                              .centre = {2, 4},
                                              .turn = 5,
                                              .radius = 6,
                                              .growth = 7,
                                              .uncertainty = 8}},
                                  .corners = {{3, {9, 10}}, {3, {11, 12}}}}))["predicted"];
  EXPECT_EQ(numbers<float>(predicted["bodies"]), (std::vector<float>{3, 1, 2, 4, 6, 8, 5, 7}));
  EXPECT_EQ(numbers<float>(predicted["corners"]), (std::vector<float>{3, 9, 10, 3, 11, 12}));

  RadarDiagnostics scan;
  scan.beams.push_back({.heading = 1, .fate = BeamFate::obstacle, .obstacle = 7});
  scan.beams.push_back({.heading = 2, .fate = BeamFate::kept, .score = 0.5});
  const Json radar = decoded(frame_message(view, scan))["radar"];
  EXPECT_EQ(numbers<float>(radar["beams"]), (std::vector<float>{1, 1, 0, 2, 0, 0.5}));
  EXPECT_EQ(numbers<std::int32_t>(radar["screens"]), (std::vector<std::int32_t>{7, -1}));

  HierarchicalDiagnostics decision{.towards = {1, 2}, .path_clearance = 3, .in_time = true};
  EXPECT_EQ(
      decoded(frame_message(view, decision))["hierarchical"],
      (Json{
          {"towards", {1.0, 2.0}}, {"path_clearance", 3.0}, {"in_time", true}, {"is_led", false}}));
  decision.wait_at = Vec2{4, 5};
  decision.wait_since = 6;
  const Json waits = decoded(frame_message(view, decision))["hierarchical"];
  EXPECT_EQ(waits["wait"], (Json{4.0, 5.0}));
  EXPECT_EQ(waits["wait_since"], 6.0);

  const AggregationDiagnostics plan{.mean_distance = 1,
                                    .leader = 2,
                                    .team_region = 3,
                                    .team_branch = 4,
                                    .moves_left = 5,
                                    .is_livelock = true};
  EXPECT_EQ(decoded(frame_message(view, plan))["gathering"], (Json{{"mean_distance", 1.0},
                                                                   {"leader", 2},
                                                                   {"region", 3},
                                                                   {"branch", 4},
                                                                   {"moves_left", 5},
                                                                   {"livelock", true}}));
}

TEST(Stream, RowsAreDoublesInTheOrderOfTheirColumns) {
  const std::vector<Row> rows{{.t = 1,
                               .position = {7, 8},
                               .clearance = 2,
                               .cost = 3,
                               .goal_distance = 4,
                               .step_time = 5,
                               .speed = 6,
                               .planned = true},
                              {.t = 2}};
  const Json json = decoded(rows_message(rows, {}, true));
  EXPECT_EQ(json["anew"], true);
  EXPECT_EQ(json["columns"].size(), 10u);
  EXPECT_EQ(json["columns"][1], "x_um");
  EXPECT_EQ(json["columns"][6], "step_time_s");
  const auto values = numbers<double>(json["rows"]);
  ASSERT_EQ(values.size(), 20u);
  EXPECT_EQ((std::vector<double>{values.begin(), values.begin() + 8}),
            (std::vector<double>{1, 7, 8, 2, 3, 4, 5, 6}));
  EXPECT_EQ(values[9], 1);
  EXPECT_EQ(values[10], 2);
}

TEST(Stream, AnswersAndStandingsSayWhatIsWrong) {
  Issues issues;
  issues.add("goal_um", "is in a wall");
  const Json answer = decoded(answer_message(7, issues));
  EXPECT_EQ(answer["id"], 7);
  EXPECT_EQ(answer["issues"][0]["keys"][0], "goal_um");
  EXPECT_EQ(answer["issues"][0]["text"], "is in a wall");
  EXPECT_EQ(answer["issues"][0]["place"], "");
  issues.add(Issue{{"tick_s"}, "is 0", "a.yaml:3:9", "0", "at least 0.001 s"});
  const Json located = decoded(answer_message(8, issues))["issues"][1];
  EXPECT_EQ(located["place"], "a.yaml:3:9");
  EXPECT_EQ(located["value"], "0");
  EXPECT_EQ(located["limit"], "at least 0.001 s");
  const Json standing =
      decoded(standing_message({.plays = true, .speed = 0, .trouble = "the disk is full"}, {}));
  EXPECT_EQ(standing["plays"], true);
  EXPECT_EQ(standing["mode"], "autonomous");
  EXPECT_EQ(standing["trouble"], "the disk is full");
  EXPECT_TRUE(standing["metrics"].is_object());
}

}  // namespace
}  // namespace microswarm::lab
