// SPDX-License-Identifier: Apache-2.0
// The crossings of a campaign that are kept to resume it.
#include <gtest/gtest.h>

#include "microswarm/config/write.hpp"
#include "microswarm/reproduce/radar/safety_campaign.hpp"
#include "tests/files.hpp"

namespace microswarm::reproduce {
namespace {

Course small_course() {
  return {.name = "small",
          .scenario =
              [](std::uint64_t seed) {
                experiment::Scenario scenario =
                    scenes::avoidance_scenario(seed, scenes::slow_obstacles);
                scenario.time_limit = 3;  // s
                return scenario;
              },
          .world = scenes::avoidance_world};
}

std::vector<Contestant> straight_stop(const Course& course) {
  std::vector<Contestant> who = contestants(course.scenario(0));
  std::erase_if(who, [](const Contestant& c) { return c.name != "straight_stop"; });
  return who;
}

Crossings cross_all(CrossingStore* store, int worlds, const Stop& stop = {}) {
  const Course course = small_course();
  return cross(
      course, straight_stop(course), {worlds}, store, [](double) {}, stop);
}

/// Everything but the wall-clock time of a decision.
std::string outcome(Crossing crossing) {
  crossing.step = 0;
  return to_json_text(crossing);
}

Crossing touching() {
  Crossing crossing;
  crossing.ran = true;
  crossing.status = Status::collided;
  crossing.arrived = true;
  crossing.obstacles = 12;
  crossing.time = 31.000000000000004;
  crossing.straight = 1.0 / 3;
  crossing.delta = 0.25;
  crossing.turning = 12.5;
  crossing.min_gap = -0.25;
  crossing.hold_time = 1e-300;
  crossing.step = 2e-6;
  crossing.contacts.push_back({.contact = {.t = 22.1,
                                           .kind = experiment::EventKind::contact_obstacle,
                                           .position = {1.5, -2.5},
                                           .clearance = 52,
                                           .speed = 6.4,
                                           .body = 4294967295U},
                               .avoidable = true,
                               .decided = 21.9,
                               .manoeuvre = "hold, retreat"});
  return crossing;
}

TEST(CrossingStore, GivesBackWhatItWasGiven) {
  const test::Folder folder;
  const auto file = folder / "c.sqlite";
  const CrossingKey key{"open", "radar", 7, "input"};
  Crossing crossing = touching();
  for (const std::optional<double> gap : {std::optional(-0.1), std::optional<double>()}) {
    crossing.min_gap = gap;
    CrossingStore(file).add(key, crossing);
    CrossingStore store(file);
    const auto stored = store.find(key);
    ASSERT_TRUE(stored);
    EXPECT_TRUE(stored->ran);
    EXPECT_EQ(stored->min_gap, gap);
    EXPECT_EQ(to_json_text(*stored), to_json_text(crossing));
    EXPECT_EQ(store.found(), 1);
    EXPECT_FALSE(store.find({"open", "radar", 8, "input"}));
    EXPECT_FALSE(store.find({"walls", "radar", 7, "input"}));
    EXPECT_FALSE(store.find({"open", "safe_interval", 7, "input"}));
    EXPECT_EQ(store.outdated(), 0);
  }
}

TEST(CrossingStore, ReplacesTheCrossingOfAnotherInput) {
  const test::Folder folder;
  CrossingStore store(folder / "c.sqlite");
  Crossing crossing = touching();
  store.add({"open", "radar", 7, "before"}, crossing);
  EXPECT_FALSE(store.find({"open", "radar", 7, "now"}));
  EXPECT_EQ(store.outdated(), 1);
  crossing.time = 5;
  store.add({"open", "radar", 7, "now"}, crossing);
  EXPECT_EQ(store.find({"open", "radar", 7, "now"})->time, 5);
  EXPECT_FALSE(store.find({"open", "radar", 7, "before"}));
}

TEST(CrossingStore, InputDiffersByScenarioNavigatorAndTracks) {
  const Course course = small_course();
  experiment::Scenario scenario = course.scenario(1);
  const std::string input = crossing_input(scenario);
  EXPECT_EQ(crossing_input(course.scenario(1)), input);
  EXPECT_NE(crossing_input(course.scenario(2)), input);
  scenario.navigator = navigation::StraightParams{.speed = 17};
  EXPECT_NE(crossing_input(scenario), input);

  Track track;
  const auto sampled = [&](double x) {
    auto samples = std::make_shared<Samples>();
    samples->times = {0, 1};
    samples->points = {{0, 0}, {x, 0}};
    track.samples = samples;
    scenario.obstacles[0].motion = track;
    return crossing_input(scenario);
  };
  EXPECT_EQ(sampled(1), sampled(1));
  EXPECT_NE(sampled(1), sampled(2));
}

TEST(CrossingStore, ResumesAnInterruptedCampaign) {
  constexpr int worlds = 12;
  const test::Folder folder;
  const Crossings whole = cross_all(nullptr, worlds);
  int rounds = 0;
  Crossings resumed;
  for (int known = 0; known < worlds && rounds < 100; ++rounds) {
    CrossingStore store(folder / "c.sqlite");
    std::atomic<bool> flag{false};
    const Course course = small_course();
    resumed = cross(
        course, straight_stop(course), {worlds}, &store,
        [&](double share) { flag = share * worlds > known + 2; }, Stop(&flag));
    EXPECT_LE(store.found(), known);
    known = static_cast<int>(std::ranges::count_if(resumed[0], &Crossing::ran));
  }
  EXPECT_GT(rounds, 1);
  ASSERT_EQ(resumed[0].size(), whole[0].size());
  for (std::size_t seed = 0; seed < worlds; ++seed)
    EXPECT_EQ(outcome(resumed[0][seed]), outcome(whole[0][seed])) << seed;

  CrossingStore store(folder / "c.sqlite");
  const Crossings again = cross_all(&store, worlds);
  EXPECT_EQ(store.found(), worlds);
  for (std::size_t seed = 0; seed < worlds; ++seed)  // with its wall-clock times: none was run
    EXPECT_EQ(to_json_text(again[0][seed]), to_json_text(resumed[0][seed])) << seed;
}

TEST(CrossingStore, RefusesOtherFilesInOneLine) {
  const test::Folder folder;
  const auto error = [&](const std::string& name) {
    return test::error_of([&] { CrossingStore(folder / name).find({"open", "radar", 7, "x"}); });
  };
  const auto line = [&](const std::string& name, const std::string& why) {
    return (folder / name).string() + ": " + why;
  };
  folder.with("text.sqlite", "This is a text, long enough to be no header.\n");
  EXPECT_EQ(error("text.sqlite"), line("text.sqlite", "is no SQLite database"));
  sweep::Database(folder.with("other.sqlite", ""), sweep::Database::Access::write)
      .run("CREATE TABLE crossings(a)");
  EXPECT_EQ(error("other.sqlite"), line("other.sqlite", "is no database of crossings"));

  CrossingStore(folder / "damaged.sqlite").add({"open", "radar", 7, "x"}, touching());
  sweep::Database(folder / "damaged.sqlite", sweep::Database::Access::write)
      .run("UPDATE crossings SET result = '{\"time_s\": \"long\"}'");
  EXPECT_EQ(error("damaged.sqlite"), line("damaged.sqlite", "is damaged: open, radar, seed 7"));
  const CrossingStore held(folder / "held.sqlite");
  EXPECT_EQ(error("held.sqlite"), line("held.sqlite", "another process is writing to it"));
}

}  // namespace
}  // namespace microswarm::reproduce
