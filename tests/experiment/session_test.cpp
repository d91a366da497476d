// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/session.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "microswarm/experiment/run/progress.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"

namespace microswarm::experiment {
namespace {

const std::filesystem::path scenarios = std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";

Experiment opened_flight() { return open_experiment(small_flight(), {}); }

std::string hash_of(Session& session) {
  session.finish();
  return session.record().hash();
}

TEST(Session, OpensScenariosAndTellsWhatIsWrong) {
  const auto file = scenarios / "papers/drrt/s_channel.yaml";
  const auto plain = open_session(file, {"time_limit_s=1", "seed=4"});
  EXPECT_EQ(plain->scenario().seed, 4u);
  EXPECT_EQ(plain->finish().status, Status::time_limit);
  EXPECT_EQ(plain->step(), nullptr);
  EXPECT_THROW(open_session(file, {"tick_s=0"}), InputError);
  EXPECT_THROW(open_session(scenarios / "no.yaml"), InputError);
}

TEST(Session, WhatIsKeptChangesNothing) {
  const Scenario scenario = small_flight();
  const Record whole = record_of(scenario);
  const RunResult result = simulate(scenario, world_of(scenario));
  EXPECT_EQ(result.status, whole.result.status);
  EXPECT_EQ(result.metrics.length, whole.result.metrics.length);
  EXPECT_EQ(result.timing.steps.size() + 1, whole.frames.size());
  Session bare(opened_flight(), {.keep = Keep::nothing});
  std::size_t ticks = 0;
  while (const Tick* tick = bare.step()) {
    ASSERT_EQ(tick->frame.pose.position, whole.frames[ticks].pose.position);
    ++ticks;
  }
  EXPECT_EQ(ticks, whole.frames.size());
}

TEST(Session, OfRobotsThatIsStoppedBeforeItsFirstTickKeepsWhereTheyAre) {
  const auto session = open_session(scenarios / "papers/gather/t_junction.yaml");
  const std::atomic<bool> yes = true;
  EXPECT_EQ(session->finish(Stop(&yes)).status, Status::stopped);
  ASSERT_EQ(session->record().robots.size(), 1u);
  EXPECT_FALSE(session->record().robots.front().positions.empty());
  EXPECT_EQ(replay(session->record()).difference, "");
}

TEST(Session, TheViewIsWhatTheTickSays) {
  Session session(opened_flight());
  EXPECT_EQ(session.view().frame.pose.position, small_flight().start->position);
  bool planned = false;
  while (const Tick* tick = session.step()) {
    const SessionView view = session.view();
    EXPECT_EQ(view.frame.t, tick->frame.t);
    EXPECT_EQ(view.bodies.size(), session.scenario().obstacles.size());
    EXPECT_EQ(view.path.size(), tick->view.path.size());
    if (view.plans > 0) planned = planned || !view.tree.empty();
    EXPECT_EQ(view.end, tick->end);
  }
  EXPECT_TRUE(planned);
}

TEST(Session, ShowsTheRadarAndTheRegions) {
  const auto radar = open_session(scenarios / "papers/radar/twelve.yaml");
  EXPECT_EQ(radar->diagnostics(), Diagnostics());
  while (radar->diagnostics() == Diagnostics()) ASSERT_TRUE(radar->step());
  const auto& scan = std::get<RadarDiagnostics>(radar->diagnostics());
  EXPECT_GE(scan.circles.detection, scan.circles.safety);
  EXPECT_GT(scan.beams.size(), 30u);

  const auto gather = open_session(scenarios / "papers/gather/t_junction.yaml");
  ASSERT_TRUE(gather->step());
  const auto& plan = std::get<AggregationDiagnostics>(gather->diagnostics());
  EXPECT_TRUE(plan.leader);
  EXPECT_GT(plan.nodes.size(), 30u);
  EXPECT_FALSE(gather->view().robots.empty());
}

TEST(Session, WhatIsSetIsRecordedAndPlayedBack) {
  Session session(opened_flight());
  for (int i = 0; i < 10; ++i) session.step();
  EXPECT_TRUE(session.set("obstacles.0.shape.radius_um", "20").empty());
  EXPECT_EQ(session.set("seed", "4").size(), 1u);
  session.finish();
  const test::Folder folder;
  const auto file = folder / "run.h5";
  session.record_to(file);

  const auto playback = open_session(file);
  EXPECT_TRUE(playback->is_playback());
  EXPECT_EQ(playback->result().status, session.result().status);
  std::size_t frames = 0;
  for (; const Tick* tick = playback->step(); ++frames) {
    const Frame& was = session.record().frames[frames];
    EXPECT_EQ(tick->frame.pose.position, was.pose.position);
    const SessionView view = playback->view();
    EXPECT_EQ(std::get<Disc>(view.bodies[0].shape).radius, frames < 10 ? 60 : 20);
    EXPECT_EQ(view.frame.state, was.state);
  }
  EXPECT_EQ(frames, session.record().frames.size());
  EXPECT_FALSE(playback->set("hold_limit_s", "3").empty());

  ASSERT_TRUE(playback->seek(4));
  EXPECT_EQ(playback->view().number, 4u);
  EXPECT_EQ(playback->view().frame.t, session.record().frames[4].t);
  EXPECT_EQ(std::get<Disc>(playback->view().bodies[0].shape).radius, 60);
  ASSERT_TRUE(playback->step());
  EXPECT_EQ(playback->view().number, 5u);
  ASSERT_TRUE(playback->seek(1'000'000));
  EXPECT_TRUE(playback->view().end);
  EXPECT_EQ(playback->view().number, frames - 1);
  EXPECT_EQ(playback->view().plans, session.view().plans);
  EXPECT_EQ(playback->step(), nullptr);
  EXPECT_FALSE(session.seek(0));
}

TEST(Session, AnotherNavigatorMovesTheDetectionRangeInTheReplayToo) {
  for (const int before : {0, 15}) {
    const auto session = open_session(scenarios / "papers/radar/single.yaml");
    for (int i = 0; i < before; ++i) session->step();
    ASSERT_TRUE(session->set("navigator.type", "safe_interval").empty());
    ASSERT_TRUE(session->set("time_limit_s", "30").empty());
    session->finish();
    EXPECT_EQ(replay(session->record()).difference, "");
  }
}

TEST(Session, ARecordOfARunThatGoesOnReplaysAsFar) {
  const test::Folder folder;
  for (const int ticks : {0, 1, 12}) {
    Session session(opened_flight());
    EXPECT_EQ(session.result().status, Status::running);
    for (int i = 0; i < ticks; ++i) session.step();
    const auto file = folder / "part.h5";
    session.record_to(file);
    const ReplayResult again = replay(read_record(file));
    EXPECT_TRUE(again.identical) << again.difference;
    const auto playback = open_session(file);
    EXPECT_EQ(playback->result().status, Status::running);
    int frames = 0;
    for (; const Tick* tick = playback->step(); ++frames) EXPECT_FALSE(tick->end);
    EXPECT_EQ(frames, ticks);
    EXPECT_EQ(playback->seek(0), ticks > 0);
    // It goes on as if it had not been recorded.
    Session other(opened_flight());
    EXPECT_EQ(hash_of(session), hash_of(other));
  }
}

TEST(Session, EachMistakeInAValueIsAnIssueOfItsKey) {
  Session session(opened_flight());
  const Issues several =
      session.set("navigator", "{type: radar, typo: 1, speed_um_per_s: bad, foo: 3}");
  EXPECT_EQ(several.size(), 3u);
  const Issues range = session.set("obstacles.0.shape.radius_um", "0");
  ASSERT_EQ(range.size(), 1u);
  EXPECT_TRUE(range.begin()->text.starts_with("radius_um is 0 µm")) << range.begin()->text;
  for (const Issue& issue : several) {
    ASSERT_EQ(issue.keys.size(), 1u);
    EXPECT_TRUE(issue.keys[0].starts_with("navigator.")) << issue.keys[0];
    EXPECT_EQ(issue.location, "");
  }
  EXPECT_EQ(several[1].keys[0], "navigator.speed_um_per_s");
  EXPECT_EQ(several[1].value, "bad");
  EXPECT_EQ(several[1].limit, "a number");
  EXPECT_EQ(session.set("goal_um=[1,1]", "3").size(), 1u);
}

TEST(Session, IsOperatedAndPlayedBack) {
  Session session(opened_flight());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(session.step());
  session.operation()->pause();
  ASSERT_TRUE(session.step());
  EXPECT_EQ(session.view().frame.state, NavigatorState::paused);
  session.operation()->pause(false);
  session.operation()->end();
  EXPECT_EQ(session.finish().status, Status::stopped);
  EXPECT_TRUE(replay(session.record()).identical);
  Session playback(session.record());
  EXPECT_EQ(playback.operation(), nullptr);
  playback.seek(5);
  EXPECT_EQ(playback.view().frame.state, NavigatorState::paused);
}

TEST(Session, AfterTheEndNothingIsSet) {
  Session session(opened_flight());
  session.finish();
  const Issues issues = session.set("time_limit_s", "30");
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues.begin()->text, "the run has ended");
  EXPECT_EQ(session.set("", "30").begin()->text, "a key is missing");
}

TEST(Session, ARecordAcceptsNoOptions) {
  const test::Folder folder;
  const auto file = folder / "run.h5";
  Session session(opened_flight());
  session.finish();
  session.record_to(file);
  EXPECT_TRUE(open_session(file)->is_playback());
  EXPECT_THROW(open_session(file, {"time_limit_s=30"}), InputError);
  EXPECT_THROW(open_session(file, {}, {.trial = 3}), InputError);
}

TEST(Session, TheViewIsTheLastTicksUntilTheNext) {
  Session session(opened_flight());
  while (session.view().tree.empty()) ASSERT_TRUE(session.step());
  const SessionView before = session.view();
  EXPECT_TRUE(session.set("navigator.speed_um_per_s", "30").empty());
  EXPECT_TRUE(session.set("navigator.speed_um_per_s", "31").empty());
  const SessionView after = session.view();  // though its navigator was replaced
  EXPECT_EQ(after.tree.size(), before.tree.size());
  EXPECT_EQ(after.path, before.path);
  ASSERT_TRUE(session.step());
  EXPECT_EQ(session.view().frame.command.speed, 31);
}

TEST(Session, ListenersHearEveryTickAndTheEnd) {
  struct Count : RunListener {
    void on_tick(const Tick&) override { ++ticks; }
    void on_end(const RunResult&) override { ++ends; }
    std::size_t ticks = 0, ends = 0;
  } count;
  Session session(opened_flight());
  session.listen(count);
  session.finish();
  EXPECT_EQ(count.ticks, session.record().frames.size());
  EXPECT_EQ(count.ends, 1u);
}

TEST(Session, TheSchemaNamesEveryKey) {
  EXPECT_NE(scenario_schema().find("\"goal_tolerance_um\""), std::string::npos);
}

}  // namespace
}  // namespace microswarm::experiment
