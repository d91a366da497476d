// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/report/page.hpp"
#include "microswarm/report/picture.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/report/rows.hpp"
#include "microswarm/report/run_picture.hpp"
#include "microswarm/report/run_report.hpp"
#include "tests/runs.hpp"

namespace microswarm::report {
namespace {

namespace fs = std::filesystem;

class Report : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(Report, PicturesAreWrittenInThreeForms) {
  Picture picture({{0, 0}, {400, 200}}, "title");
  picture.disc({{100, 100}, 30}, colours::obstacle);
  picture.mark({10, 10}, "start");
  for (const auto& [name, head] :
       {std::pair{"a.png", "\x89PNG"}, std::pair{"a.pdf", "%PDF"}, std::pair{"a.svg", "<?xml"}}) {
    picture.write(folder_ / name);
    EXPECT_EQ(read_file(folder_ / name).substr(0, std::string(head).size()), head);
  }
  EXPECT_THROW(picture.write(folder_ / "a.gif"), InputError);
}

TEST_F(Report, ThePixelOfADiscHasItsColour) {
  Picture picture({{0, 0}, {100, 100}}, "", 100);
  picture.disc({{25, 75}, 10}, {1, 0, 0, 1});  // y up: in the picture's upper left
  picture.write(folder_ / "a.png");
  const formats::Image image = formats::read_image(folder_ / "a.png");
  const std::size_t i = image.index(24 + 25, 24 + 25);
  EXPECT_EQ(image.pixels[i], 255);
  EXPECT_EQ(image.pixels[i + 1], 0);
}

TEST_F(Report, ASheetHoldsItsPicturesRowByRow) {
  std::vector<std::unique_ptr<Picture>> pictures;
  for (const Colour& colour : {Colour{1, 0, 0, 1}, Colour{0, 1, 0, 1}, Colour{0, 0, 1, 1}}) {
    pictures.push_back(std::make_unique<Picture>(Box{{0, 0}, {100, 100}}, "", 100));
    pictures.back()->disc({{50, 50}, 20}, colour);
    pictures.back()->write(folder_ / "one.png");
  }
  const formats::Image one = formats::read_image(folder_ / "one.png");
  write_sheet(pictures, 2, folder_ / "sheet.png");
  const formats::Image sheet = formats::read_image(folder_ / "sheet.png");
  EXPECT_EQ(sheet.width, 2 * one.width);
  EXPECT_EQ(sheet.height, 2 * one.height);
  const auto channel_at = [&](int across, int down, std::size_t channel) {
    return sheet.pixels[sheet.index(across * one.width + 74, down * one.height + 74) + channel];
  };
  EXPECT_EQ(channel_at(0, 0, 0), 255);
  EXPECT_EQ(channel_at(1, 0, 1), 255);
  EXPECT_EQ(channel_at(0, 1, 2), 255);
  EXPECT_EQ(channel_at(1, 1, 0), 255) << "white";
  EXPECT_EQ(channel_at(1, 1, 2), 255) << "white";
  write_sheet({}, 2, folder_ / "none.png");
  EXPECT_FALSE(fs::exists(folder_ / "none.png"));
}

TEST_F(Report, PlotsAreWrittenAndNothingElseIsLeft) {
  write_plots({{.title = "a \"quoted\" title",
                .x_label = "x",
                .y_label = "y",
                .series = {{.label = "s", .x = {1, 2, 3}, .y = {1, 4, 9}}},
                .levels = {{"level", 5}}}},
              folder_ / "p.png");
  EXPECT_EQ(read_file(folder_ / "p.png").substr(1, 3), "PNG");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
  EXPECT_THROW(write_plots({}, folder_ / "missing" / "p.png"), InputError);
}

TEST_F(Report, NoTextOfAPlotIsACommand) {
  const fs::path made = folder_ / "made";
  const std::string evil = "`touch " + made.string() + "` \"\n!touch " + made.string();
  write_plots({{.title = evil,
                .x_label = evil,
                .y_label = evil,
                .series = {{.label = evil, .x = {0, 1}, .y = {0, 1}}},
                .x_ticks = {{evil, 1}}}},
              folder_ / "evil.png");
  EXPECT_FALSE(fs::exists(made));
}

TEST_F(Report, EveryStyleIsUnderstoodByGnuplotInEveryKindOfFile) {
  Plot plot{.title = "styles", .x_ticks = {{"2¹⁰", 2}}, .log_x = true, .log_y = true};
  for (const PlotStyle style :
       {PlotStyle::line, PlotStyle::marked, PlotStyle::points, PlotStyle::rings, PlotStyle::bars,
        PlotStyle::box, PlotStyle::filled, PlotStyle::published})
    plot.series.push_back({.label = "s",
                           .x = {1, 2, 3},
                           .y = {2, 4, 9},
                           .style = style,
                           .low = {1, 2, 8},
                           .high = {3, 6, 10}});
  write_plots_everywhere({plot}, folder_ / "fig2.5");
  for (const char* name : {"fig2.5.png", "fig2.5.svg", "fig2.5.pdf"})
    EXPECT_GT(fs::file_size(folder_ / name), 1000U) << name;
}

TEST_F(Report, OfARunThatWasStoppedBeforeItsFirstTick) {
  const fs::path file = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios/first_flight.yaml";
  const experiment::Scene scene =
      experiment::load_scene(experiment::read_scenario(file), file.parent_path());
  const std::atomic<bool> stopped = true;
  write_run_report(test::record_of(scene, {}, Stop(&stopped)), folder_);
  EXPECT_TRUE(fs::exists(folder_ / "index.html"));
  EXPECT_TRUE(fs::exists(folder_ / "plots.png"));
}

TEST_F(Report, ARunIsDrawnWithItsChanges) {
  experiment::Scenario scenario;
  scenario.map = formats::PolygonsMap{.hi = {1200, 600}};  // a pixel is 1 µm
  scenario.start = Pose2{{100, 300}, 0};
  scenario.goal = Vec2{1000, 300};
  scenario.time_limit = 2;
  experiment::Record record = test::record_of(experiment::load_scene(scenario, {}));
  const auto is_goal_at = [&](Vec2 goal) {
    const formats::Image image = draw_run(record)->raster();
    const int left = 24, top = 58;  // of the drawing
    const std::size_t i =
        image.index(left + static_cast<int>(goal.x) + 9, top + 600 - static_cast<int>(goal.y));
    return image.pixels[i] == 138 && image.pixels[i + 1] == 63;
  };
  EXPECT_TRUE(is_goal_at({1000, 300}));
  record.changes.push_back({.t = 1, .frame = 10, .setting = "goal_um=[700, 200]"});
  EXPECT_TRUE(is_goal_at({700, 200}));
  EXPECT_FALSE(is_goal_at({1000, 300}));
  EXPECT_EQ(draw_run(record)->png().substr(1, 3), "PNG");
}

TEST_F(Report, PagesEscapeText) {
  write_page(folder_ / "i.html", "a < b", {{.heading = "x & y"}});
  const std::string html = read_file(folder_ / "i.html");
  EXPECT_NE(html.find("a &lt; b"), std::string::npos);
  EXPECT_NE(html.find("x &amp; y"), std::string::npos);
}

TEST(Rows, SayWhetherTheAimIsMet) {
  EXPECT_TRUE((ReproduceRow{.ours = 1, .aim = 1}.ok()));
  EXPECT_FALSE((ReproduceRow{.ours = 2, .aim = 1}.ok()));
  EXPECT_TRUE((ReproduceRow{.ours = 2, .aim = 1, .at_most = false}.ok()));
  EXPECT_TRUE((ReproduceRow{.ours = 2}.ok()));
  EXPECT_FALSE((ReproduceRow{.aim = 1}.ok()));
  EXPECT_FALSE((ReproduceRow{.aim = 0, .at_most = false}.ok()));
  EXPECT_FALSE(all_ok(std::vector<BenchRow>{{.ours = 3, .aim = 2}}));
}

TEST(Rows, WhatCannotBeJudgedKeepsItsAimButHasNoVerdict) {
  const ReproduceRow few{.ours = 2, .aim = 1, .note = "too few trials", .judged = false};
  EXPECT_TRUE(few.ok());
  EXPECT_FALSE(few.has_verdict());
  EXPECT_TRUE(all_ok(std::vector{few}));
  const std::string table = rows_table({few});
  EXPECT_NE(table.find("≤ 1  no verdict  too few trials\n"), std::string::npos) << table;
  EXPECT_EQ(rows_csv({few}),
            "figure,quantity,unit,paper,ours,aim,ok,note\n,,,,2,1,,too few trials\n");
  const std::string json = rows_json({few});
  EXPECT_NE(json.find("\"ok\": null"), std::string::npos) << json;
  EXPECT_NE(json.find("\"aim\": 1.0"), std::string::npos) << json;
}

TEST(Rows, WithoutAnAimThereIsNoVerdict) {
  EXPECT_NE(rows_json({ReproduceRow{.ours = 2}}).find("\"ok\": null"), std::string::npos);
  EXPECT_NE(rows_json({ReproduceRow{.ours = 2, .aim = 1}}).find("\"ok\": false"),
            std::string::npos);
}

TEST(Rows, ABenchIsOkIfAsGoodAsItsPeerAndItsAim) {
  EXPECT_TRUE((BenchRow{.ours = 2, .peer = 2, .aim = 2}.ok()));
  EXPECT_FALSE((BenchRow{.ours = 2, .peer = 1, .aim = 2}.ok()));
  EXPECT_FALSE((BenchRow{.ours = 2, .peer = 3, .aim = 1}.ok()));
  EXPECT_FALSE((BenchRow{.ours = 2, .peer = 1}.ok()));
  EXPECT_FALSE((BenchRow{.ours = 2, .peer = 3, .at_most = false}.ok()));
  EXPECT_TRUE((BenchRow{.ours = 3, .peer = 2, .aim = 3, .at_most = false}.ok()));
  EXPECT_NE(rows_json({BenchRow{.ours = 2}}).find("\"ok\": null"), std::string::npos);
}

TEST(Rows, RatiosAreAboveOneWhereWeAreFaster) {
  EXPECT_EQ((BenchRow{.ours = 2, .peer = 10}.ratio()), 5);
  EXPECT_EQ((BenchRow{.ours = 10, .peer = 2, .at_most = false}.ratio()), 5);
  EXPECT_FALSE((BenchRow{.ours = 10}.ratio()));
}

TEST(Rows, NothingMeasuredIsNoZero) {
  const std::vector<ReproduceRow> rows{{.figure = "f", .quantity = "median", .unit = "s"}};
  EXPECT_EQ(rows_csv(rows), "figure,quantity,unit,paper,ours,aim,ok,note\nf,median,s,,,,,\n");
  EXPECT_NE(rows_json(rows).find("\"ours\": null"), std::string::npos);
  EXPECT_EQ(rows_table(rows).find('0'), std::string::npos);
}

TEST(Rows, JsonHasThePromisedKeys) {
  const std::string json = rows_json({ReproduceRow{.figure = "3c", .quantity = "q", .unit = "µm"}});
  for (const char* key : {"rows", "figure", "quantity", "unit", "paper", "ours", "aim", "ok"})
    EXPECT_NE(json.find('"' + std::string(key) + '"'), std::string::npos) << key;
}

}  // namespace
}  // namespace microswarm::report
