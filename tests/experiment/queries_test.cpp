// SPDX-License-Identifier: Apache-2.0
// Gathering and plans for several robots, as front ends ask for them.
#include <gtest/gtest.h>

#include <limits>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/queries/gather_query.hpp"
#include "microswarm/experiment/queries/global_query.hpp"
#include "microswarm/experiment/session/replay.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/formats/write_map.hpp"

namespace microswarm::experiment {
namespace {

constexpr Box bounds{{0, 0}, {400, 400}};

/// A room with a block in the middle.
Map room() { return Map(bounds, {Polygon{{{150, 150}, {250, 150}, {250, 250}, {150, 250}}, {}}}); }

formats::PolygonsMap spec() {
  formats::PolygonsMap spec;
  spec.lo = bounds.lo;
  spec.hi = bounds.hi;
  return spec;
}

GatherQuery gather_query() {
  return {.goal = {60, 60}, .robots = 8, .channel_width = 100, .max_steps = 20};
}

TEST(GatherQuery, TheRecordOfAMapInMemoryReplays) {
  GatherExperiment made = open_gathering(formats::to_parts(room()), spec(), gather_query(), "room");
  EXPECT_EQ(made.experiment.scenario().robots->count, 8);
  EXPECT_GT(made.measured_width, 0);
  Session session(std::move(made.experiment));
  session.finish();
  EXPECT_EQ(session.result().timing.steps.size(), 20u);
  EXPECT_TRUE(replay(session.record()).identical);
}

TEST(GatherQuery, StartsStandInPlaceOfANumber) {
  GatherQuery query = gather_query();
  query.starts = {{100, 100}, {300, 320}};
  const GatherExperiment made = open_gathering(formats::to_parts(room()), spec(), query, "room");
  EXPECT_EQ(made.experiment.scenario().robots->count, 0);
  EXPECT_EQ(made.experiment.scenario().robots->starts, query.starts);
  query.starts = {{200, 200}};
  EXPECT_THROW(open_gathering(formats::to_parts(room()), spec(), query, "room"), InputError);
  query.goal = {200, 200};
  EXPECT_THROW(open_gathering(formats::to_parts(room()), spec(), query, "room"), InputError);
}

// A hall 300 µm wide, and a room of 30 µm behind a corridor of 4 µm.
TEST(GatherQuery, AGoalInANarrowPlaceIsNotReachedFromTheHall) {
  const Box box{{0, 0}, {400, 300}};
  const Map map(
      box, {Polygon{{{300, 0}, {400, 0}, {400, 135}, {360, 135}, {360, 148}, {300, 148}}, {}},
            Polygon{{{300, 152}, {360, 152}, {360, 165}, {400, 165}, {400, 300}, {300, 300}}, {}}});
  formats::PolygonsMap source;
  source.lo = box.lo;
  source.hi = box.hi;
  GatherQuery query{.goal = {385, 150}, .robots = 32, .max_steps = 20};
  GatherExperiment made = open_gathering(formats::to_parts(map), source, query, "hall");
  EXPECT_GT(made.measured_width, 100);
  EXPECT_NEAR(made.experiment.scenario().goal_tolerance, 30, 3);
  Session session(std::move(made.experiment));
  EXPECT_NE(session.finish().status, Status::solved);
  EXPECT_TRUE(session.notes().empty());
}

TEST(GatherQuery, RobotsThatAreGatheredAtTheStartAreANote) {
  GatherQuery query = gather_query();
  query.starts = {{60, 60}, {70, 60}};
  Session session(open_gathering(formats::to_parts(room()), spec(), query, "room").experiment);
  EXPECT_EQ(session.finish().status, Status::solved);
  ASSERT_EQ(session.notes().size(), 1u);
  EXPECT_NE(session.notes()[0].find(" µm, is within goal_tolerance_um, 100 µm"), std::string::npos)
      << session.notes()[0];
}

// While the run holds at the goal, robots are gathered down to half of the tolerance, then rest.
TEST(GatherQuery, RobotsThatAreGatheredComeToRest) {
  GatherQuery query = gather_query();
  query.max_steps = 5000;
  query.settings = Settings(std::vector<std::string>{"hold_at_goal_s=300"}, "--set");
  Session session(open_gathering(formats::to_parts(room()), spec(), query, "room").experiment);
  ASSERT_EQ(session.finish().status, Status::solved);
  const auto& frames = session.record().frames;
  const double arrived = session.result().metrics.time;
  double moved_until = 0;
  for (const auto& frame : frames)
    if (frame.command.speed > 0) moved_until = frame.t;
  EXPECT_LT(frames.back().goal_distance, 50);
  EXPECT_LT(moved_until, arrived + 100);
}

// Nothing keeps the result of which a note would speak.
TEST(GatherQuery, ASessionThatKeepsNothingEndsAtTheGoalToo) {
  GatherQuery query = gather_query();
  query.starts = {{60, 60}, {70, 60}};
  Session session(open_gathering(formats::to_parts(room()), spec(), query, "room").experiment,
                  {.keep = Keep::nothing});
  const Tick* tick = session.step();
  ASSERT_NE(tick, nullptr);
  EXPECT_EQ(tick->end, Status::solved);
  EXPECT_TRUE(session.notes().empty());
}

GlobalQuery global_query() {
  return {.starts = {{60, 300}, {60, 250}}, .goals = {{330, 300}, {330, 200}}};
}

TEST(GlobalQuery, BothPlannersAnswerAndSayWhatTheyUsed) {
  GlobalQuery query = global_query();
  for (const char* planner : {"global_search", "global_rrt"}) {
    query.settings = {std::string("planner.type=") + planner, "planner.goal_tolerance_um=30"};
    query.shorten = false;
    const GlobalAnswer found = answer(room(), query, "room");
    query.shorten = true;
    const GlobalAnswer shorter = answer(room(), query, "room");
    ASSERT_EQ(found.plan.status, Status::solved) << planner;
    EXPECT_EQ(found.why_none(), "");
    EXPECT_EQ(to_play(found.planner).goal_tolerance, 30);
    EXPECT_EQ(found.plan.inputs.size(), found.inputs_found);
    EXPECT_EQ(shorter.inputs_found, found.inputs_found);
    EXPECT_LE(shorter.plan.inputs.size(), found.inputs_found);
    EXPECT_FALSE(found.tree);
  }
}

TEST(GlobalQuery, ATreeIsKeptOnRequestAlsoWithoutGoals) {
  GlobalQuery query = global_query();
  query.goals.clear();
  query.keep_tree = true;
  query.settings = {"planner.max_nodes=500"};
  const GlobalAnswer made = answer(room(), query, "room");
  ASSERT_TRUE(made.tree);
  EXPECT_EQ(made.tree->size(), 500u);
  EXPECT_EQ(made.plan.status, Status::node_limit);
  query.settings = {"planner.type=global_search"};
  EXPECT_THROW(answer(room(), query, "room"), InputError);
}

TEST(GlobalQuery, RefusesWhatIsNoPosition) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec2 bad : {Vec2{nan, 1}, Vec2{200, 200}, Vec2{-5, 1}}) {
    GlobalQuery query = global_query();
    query.starts[1] = bad;
    EXPECT_THROW(answer(room(), query, "room"), InputError);
    query = global_query();
    query.goals[0] = bad;
    EXPECT_THROW(answer(room(), query, "room"), InputError);
  }
}

}  // namespace
}  // namespace microswarm::experiment
