// SPDX-License-Identifier: Apache-2.0
// What is set while an experiment runs, and that a replay repeats it.
#include <gtest/gtest.h>

#include "microswarm/experiment/session/session.hpp"
#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

/// A run that is recorded tick by tick.
struct Recorded : Session {
  explicit Recorded(const Scenario& scenario, std::shared_ptr<Navigator> theirs = nullptr)
      : Session(open_experiment(scenario, {}), {.navigator = std::move(theirs)}) {}
  void step(int ticks) {
    for (int i = 0; i < ticks; ++i) ASSERT_TRUE(Session::step());
  }
  Record finish() {
    Session::finish();
    return record();
  }
};

Issues change(Session& session, std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  return session.set(std::string(text.substr(0, equals)),
                     std::string(text.substr(std::min(equals + 1, text.size()))));
}

std::string first(const Issues& issues) { return issues.empty() ? "" : issues.begin()->text; }

TEST(SessionChanges, WhatIsChangedHoldsFromTheNextTickOnAndIsRepeated) {
  const Scenario scenario = small_flight();
  Recorded run(scenario);
  run.step(5);
  EXPECT_EQ(first(change(run, "navigator.speed_um_per_s=31")), "");
  run.step(5);
  EXPECT_EQ(first(change(run, "goal_tolerance_um=77")), "");
  EXPECT_EQ(first(change(run, "hold_limit_s=7")), "");
  const Record record = run.finish();
  ASSERT_GT(record.frames.size(), 12u);
  EXPECT_NE(record.frames[4].command.speed, 31);
  EXPECT_EQ(record.frames[5].command.speed, 31);
  ASSERT_EQ(record.changes.size(), 3u);
  EXPECT_EQ(record.changes[0].frame, 5u);
  EXPECT_EQ(record.changes[0].t, record.frames[5].t);
  EXPECT_EQ(record.changes[1].setting, "goal_tolerance_um=77");
  EXPECT_EQ(record.result.status, Status::solved);
  EXPECT_LE(record.result.metrics.goal_distance, 77 + 1e-9);

  const ReplayResult again = replay(record);
  EXPECT_TRUE(again.identical) << again.difference;
  Record unchanged = record;
  unchanged.changes.clear();
  EXPECT_FALSE(replay(unchanged).identical);
  EXPECT_NE(unchanged.hash(), record.hash());
  Record refused = record;
  refused.changes[0].setting = "tick_s=1";
  EXPECT_NE(replay(refused).difference.find("tick_s"), std::string::npos);
}

TEST(SessionChanges, ARecordKeepsItsChanges) {
  Recorded run(small_flight());
  EXPECT_EQ(first(change(run, "hold_limit_s=9")), "");  // before the first tick
  run.step(3);
  EXPECT_EQ(first(change(run, "navigator.speed_um_per_s=25")), "");
  const Record record = run.finish();
  const auto file = empty_folder("changed_record") / "run.h5";
  write_record(record, file);
  const Record read = read_record(file);
  ASSERT_EQ(read.changes.size(), 2u);
  EXPECT_EQ(read.changes[0].frame, 0u);
  EXPECT_EQ(read.changes[1].setting, "navigator.speed_um_per_s=25");
  EXPECT_EQ(read.hash(), record.hash());
  EXPECT_TRUE(replay(read).identical);
}

/// Reports a waypoint off the straight line for the middle part of its path.
class Phased : public GoStraight {
 public:
  using GoStraight::GoStraight;
  Command step(const Observation& seen, const Stop& stop) override {
    x_ = seen.swarm ? seen.swarm->pose.position.x : 0;
    return GoStraight::step(seen, stop);
  }
  NavigatorView view() const override {
    NavigatorView view = GoStraight::view();
    if (x_ > 400 && x_ < 1200) view.phased_goal = Vec2{x_ < 800 ? 800. : 1200., 900};
    return view;
  }

 private:
  double x_ = 0;
};

TEST(SessionChanges, PhasedGoalsOfAnExternalNavigatorAreRepeated) {
  Scenario scenario = open_room();
  scenario.obstacles = {disc(60, Still{.position = {900, 700}})};
  scenario.detection_range = 1000;
  Recorded run(scenario, std::make_unique<Phased>(*scenario.goal, 60));
  const Record record = run.finish();
  EXPECT_EQ(record.result.status, Status::solved);
  EXPECT_GT(record.result.metrics.avoidance.mean_cost, 0);
  const auto file = empty_folder("phased_record") / "run.h5";
  write_record(record, file);
  for (const Record& one : {record, read_record(file)}) {
    ASSERT_EQ(one.phased_goals.size(), 3u);
    EXPECT_EQ(one.phased_goals[1].point, (Vec2{1200, 900}));
    EXPECT_FALSE(one.phased_goals[2].point);
    const ReplayResult again = replay(one);
    EXPECT_TRUE(again.identical) << again.difference;
  }
  Record forgotten = record;
  forgotten.phased_goals.clear();
  EXPECT_NE(replay(forgotten).difference.find("avoidance_cost"), std::string::npos);
}

TEST(SessionChanges, AnObstacleThatIsPutInTheWayIsMet) {
  Scenario scenario = open_room();
  scenario.obstacles = {disc(60, Still{.position = {500, 900}})};
  Recorded run(scenario, std::make_unique<GoStraight>(*scenario.goal, 60));
  run.step(3);
  EXPECT_EQ(first(change(run, "obstacles.0.motion.position_um=[600, 500]")), "");
  const Record record = run.finish();
  EXPECT_EQ(record.result.status, Status::collided);
  ASSERT_FALSE(record.events.empty());
  EXPECT_EQ(record.events.back().kind, EventKind::contact_obstacle);
}

TEST(SessionChanges, WhatCannotBeChangedIsSaidAndNothingChanges) {
  Recorded run(small_flight());
  run.step(2);
  const std::string before = scenario_text(run.scenario());
  for (const char* setting :
       {"tick_s=1", "swarm.radius_um=20", "map.hi_um=[1, 1]", "seed=3", "no_key=1", "goal_um=[1",
        "goal_um=[-500, 20]", "navigator.speed_um_per_s=fast", "navigator.clearance_um=5000",
        "obstacles=[{shape: {type: polygon, vertices_um: [[0, 0]]}, motion: {type: still}}]",
        "hold_limit_s=1\ntick_s=3", "navigator.follower={kind: learned, model: m.yaml}", ""})
    EXPECT_FALSE(change(run, setting).empty()) << setting;
  EXPECT_EQ(scenario_text(run.scenario()), before);
  EXPECT_TRUE(run.finish().changes.empty());

  Recorded theirs(open_room(), std::make_unique<GoStraight>(Vec2{1, 1}, 5));
  EXPECT_FALSE(change(theirs, "navigator.speed_um_per_s=3").empty());
  EXPECT_FALSE(change(theirs, "goal_um=[500, 500]").empty());
  EXPECT_TRUE(change(theirs, "hold_limit_s=3").empty());
}

}  // namespace
}  // namespace microswarm::experiment
