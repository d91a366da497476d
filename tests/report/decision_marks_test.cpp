// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/decision_marks.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/report/run_picture.hpp"
#include "microswarm/report/run_report.hpp"
#include "tests/files.hpp"

namespace microswarm::report {
namespace {

/// A picture of 400 by 200 µm, a pixel each.
class DecisionMarks : public testing::Test {
 protected:
  void draw(const Diagnostics& shown, Vec2 at = {}, std::span<const Vec2> robots = {}) {
    draw_decision(picture_, shown, scenario_, at, robots);
    image_ = picture_.raster();
  }
  /// Whether the pixel is clearly of this colour, over white.
  bool is(Vec2 p, Colour colour) const {
    const auto* pixel = &image_.pixels[index(p)];
    const auto near = [&](int channel, double value) {
      return std::abs(pixel[channel] - 255 * (1 + colour.alpha * (value - 1))) < 60;
    };
    return !is_blank(p) && near(0, colour.red) && near(1, colour.green) && near(2, colour.blue);
  }
  bool is_blank(Vec2 p) const {
    const auto* pixel = &image_.pixels[index(p)];
    return pixel[0] == 255 && pixel[1] == 255 && pixel[2] == 255;
  }
  /// Whether something is drawn within a pixel of it.
  bool is_drawn(Vec2 p) const {
    for (const double x : {-1, 0, 1})
      for (const double y : {-1, 0, 1})
        if (!is_blank(p + Vec2{x, y})) return true;
    return false;
  }

  experiment::Scenario scenario_;

 private:
  std::size_t index(Vec2 p) const {
    const int margin = 24;
    return image_.index(margin + static_cast<int>(p.x), margin + static_cast<int>(200 - p.y));
  }
  Picture picture_{Box{{0, 0}, {400, 200}}, "", 400};
  formats::Image image_;
};

TEST_F(DecisionMarks, OfARadarAreTheScreenedDirectionsAndTheOneTaken) {
  const Vec2 at{200.5, 100.5};
  RadarDiagnostics scan{.radius = 10,
                        .circles = {.detection = 60},
                        .best = 1,
                        .beams = {{.heading = 0, .fate = BeamFate::obstacle},
                                  {.heading = 0.5 * pi},
                                  {.heading = pi, .fate = BeamFate::wall},
                                  {.heading = 1.5 * pi, .fate = BeamFate::turn},
                                  {.heading = 0.25 * pi}}};
  draw(scan, at);
  EXPECT_TRUE(is(at + Vec2{40, 0}, colours::radar_obstacle));
  EXPECT_TRUE(is(at + Vec2{-40, 0}, colours::radar_wall));
  EXPECT_TRUE(is(at + Vec2{0, -40}, colours::radar_turn));
  EXPECT_TRUE(is(at + Vec2{0, 40}, colours::radar_chosen));
  EXPECT_TRUE(is_blank(at + Vec2{28, 28})) << "kept, not taken";
  EXPECT_TRUE(is_blank(at + Vec2{5, 0})) << "in the swarm";
}

TEST_F(DecisionMarks, OfARadarThatDetectsNothingIsTheStraightHeading) {
  draw(RadarDiagnostics{.radius = 10, .circles = {.detection = 60}, .straight = pi},
       {200.5, 100.5});
  EXPECT_TRUE(is({150.5, 100.5}, colours::radar_chosen));
}

TEST_F(DecisionMarks, OfPredictedBodiesAreTheTurnedAndGrownOutlines) {
  const Vec2 centre{100, 100}, disc{300, 100};
  const double corner = std::sqrt(800.0);  // of a square with the side 40, its growth is 10
  draw(PredictiveDiagnostics{
      .bodies =
          {{.body = 4, .centre = centre, .turn = 0.25 * pi, .radius = corner + 10, .growth = 10},
           {.body = 2, .centre = disc, .radius = 30, .growth = 5}},
      .corners = {{4, {20, 20}}, {4, {-20, 20}}, {4, {-20, -20}}, {4, {20, -20}}}});
  for (const Vec2 along : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
    EXPECT_TRUE(is_drawn(centre + (corner + 10) * along)) << "corner";
    EXPECT_FALSE(is_drawn(centre + corner * along)) << "without growth";
    EXPECT_TRUE(is_drawn(disc + 30 * along)) << "disc";
    const Vec2 diagonal = rotated(along, 0.25 * pi);
    EXPECT_TRUE(is_drawn(centre + 30 * diagonal)) << "middle of a side";
    EXPECT_FALSE(is_drawn(centre + (corner + 10) * diagonal)) << "circle around it";
  }
}

TEST_F(DecisionMarks, OfHierarchicalDrrtStarAreRoutePointAndWait) {
  scenario_.goal = Vec2{350, 50};
  draw(HierarchicalDiagnostics{.towards = {100, 100}, .wait_since = 2, .wait_at = Vec2{200, 100}});
  EXPECT_TRUE(is_drawn({109, 100}));
  EXPECT_TRUE(is_drawn({209, 100}));
}

TEST_F(DecisionMarks, TheGoalIsNoRoutePoint) {
  scenario_.goal = Vec2{100, 100};
  draw(HierarchicalDiagnostics{.towards = {100, 100}});
  EXPECT_FALSE(is_drawn({109, 100}));
}

TEST_F(DecisionMarks, OfAGatheringAreLeaderAndTeam) {
  AggregationDiagnostics plan{.leader = 1,
                              .team_region = 2,
                              .team_branch = 1,
                              .nodes = {{.position = {50, 50}, .region = 2, .branch = 1},
                                        {.position = {150, 50}, .region = 2, .branch = 1},
                                        {.position = {150, 150}, .next = 1, .region = 2},
                                        {.position = {50, 150}, .region = 1, .branch = 1}}};
  const std::vector<Vec2> robots{{300, 50}, {300, 150}};
  draw(plan, {}, robots);
  EXPECT_TRUE(is_drawn({100, 50}));
  EXPECT_FALSE(is_drawn({150, 100})) << "another branch";
  EXPECT_FALSE(is_drawn({50, 100})) << "another region";
  EXPECT_TRUE(is_drawn({309, 150}));
  EXPECT_FALSE(is_drawn({309, 50}));
  plan.leader = 2;  // as a damaged record may have it
  plan.nodes[0].next = 9;
  EXPECT_NO_THROW(draw(plan, {}, robots));
}

/// The record of a scenario that keeps its diagnostics.
experiment::Record kept(const char* file, std::vector<std::string> settings) {
  settings.push_back("record.diagnostics=true");
  const auto session = experiment::open_session(
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios" / file, Settings(settings, ""));
  session->finish();
  return session->record();
}

TEST(Decisions, AreInThePictureOfARunThatKeepsThem) {
  for (const auto& [file, settings] :
       {std::pair{"papers/radar/twelve.yaml", std::vector<std::string>{"time_limit_s=4"}},
        {"papers/radar/twelve.yaml", {"time_limit_s=2", "navigator.type=safe_interval"}},
        {"papers/gather/t_junction.yaml", {"time_limit_s=2"}}}) {
    experiment::Record record = kept(file, settings);
    ASSERT_FALSE(record.diagnostics.empty());
    const std::string with = draw_run(record)->png();
    for (auto& row : record.diagnostics.radar) {  // the circles stay
      for (RadarBeam& beam : row.shown.beams) beam.fate = BeamFate::kept;
      row.shown.best.reset(), row.shown.straight.reset();
    }
    for (auto& row : record.diagnostics.predictive) row.shown.bodies.clear();
    for (auto& row : record.diagnostics.aggregation)
      row.shown.leader.reset(), row.shown.team_region.reset(), row.shown.moves_left.reset();
    EXPECT_NE(with, draw_run(record)->png()) << file << " " << settings.back();
  }
}

TEST(Decisions, AreInTheMomentsOfAReport) {
  experiment::Record record = kept("papers/drrt/moving_obstacles.yaml", {"time_limit_s=2"});
  ASSERT_FALSE(record.diagnostics.hierarchical.empty());
  for (auto& row : record.diagnostics.hierarchical) row.shown.towards = {1600, 1400};
  const auto moment = [&](const test::Folder& folder) {
    write_run_report(record, folder / "report");
    return read_file(folder / "report/moment-1.png");
  };
  const test::Folder folder;
  std::filesystem::create_directories(folder / "report");
  const std::string with = moment(folder);
  record.diagnostics = {};
  EXPECT_NE(with, moment(folder));
}

TEST(Decisions, AtTheEndAreThoseOfTheLastTick) {
  experiment::Record record;
  record.frames.resize(3);
  for (int i = 0; i < 3; ++i) {
    record.frames[static_cast<std::size_t>(i)].t = i;
    if (i < 2) record.diagnostics.add(i, HierarchicalDiagnostics{.path_clearance = 1.0 + i});
  }
  const auto clearance = [&](double t) {
    return std::get<HierarchicalDiagnostics>(decision_at(record, t)).path_clearance;
  };
  EXPECT_EQ(clearance(0), 1);
  EXPECT_EQ(clearance(1), 2);
  EXPECT_EQ(clearance(2), 2);
}

}  // namespace
}  // namespace microswarm::report
