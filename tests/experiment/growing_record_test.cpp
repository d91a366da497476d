// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/growing_record.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <thread>

#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"

namespace microswarm::experiment {
namespace {

using namespace std::chrono_literals;

TEST(PartFiles, AreNamedAfterTheirRecord) {
  EXPECT_EQ(part_file("out/run.h5"), "out/run.part.h5");
  EXPECT_EQ(whole_file("out/run.part.h5"), "out/run.h5");
  EXPECT_EQ(whole_file(part_file("run.h5")), "run.h5");
  for (const char* other : {"run.h5", "out/.part.h5", "part.h5", "x.part/run.h5"})
    EXPECT_EQ(whole_file(other), "") << other;
}

/// Of so many ticks that no computer comes to its end here.
Scenario long_flight() {
  Scenario scenario = small_flight();
  scenario.tick = 0.001;
  return scenario;
}

/// Steps until it holds; the session goes on all the time.
bool step_until(Session& session, const std::function<bool()>& holds) {
  const auto latest = Stop::Clock::now() + 300s;  // with a sanitizer on a busy computer
  for (int i = 0; Stop::Clock::now() < latest; ++i) {
    if (i % 20 == 0 && holds()) return true;
    if (!session.step()) return holds();
    std::this_thread::sleep_for(1ms);  // slower than the file is written
  }
  return false;
}

TEST(GrowingRecords, AreWholeRecordsOfTheRunSoFar) {
  const test::Folder folder;
  const auto part = folder / "run.part.h5";
  Session session(open_experiment(long_flight(), {}));
  std::optional<GrowingRecord> growing(std::in_place, session, folder / "run.h5", 1ms);
  ASSERT_TRUE(step_until(session, [&] { return std::filesystem::exists(part); }));
  const Record first = read_record(part);
  EXPECT_EQ(first.result.status, Status::running);
  EXPECT_GT(first.frames.size(), 0u);
  EXPECT_LE(first.frames.size(), session.record().frames.size());
  EXPECT_TRUE(replay(first).identical);
  ASSERT_TRUE(
      step_until(session, [&] { return read_record(part).frames.size() > first.frames.size(); }));
  Session alone(open_experiment(long_flight(), {}));
  while (alone.record().frames.size() < session.record().frames.size()) alone.step();
  EXPECT_EQ(session.record().hash(), alone.record().hash());
}

TEST(GrowingRecords, RemainUntilTheWholeRecordIsInPlace) {
  const test::Folder folder;
  const auto whole = folder / "run.h5", part = folder / "run.part.h5";
  for (const bool is_written : {false, true, false}) {  // the last beside a record of before
    std::filesystem::remove(part);
    Session session(open_experiment(long_flight(), {}));
    std::optional<GrowingRecord> growing(std::in_place, session, whole, 1ms);
    ASSERT_TRUE(step_until(session, [&] { return std::filesystem::exists(part); }));
    if (is_written) session.record_to(whole);
    growing.reset();
    EXPECT_EQ(std::filesystem::exists(part), !is_written);
    if (!is_written) {
      EXPECT_GT(read_record(part).frames.size(), 0u);
    }
  }
  const auto no_file = folder / "full/run.h5";  // that nobody can write
  std::filesystem::create_directories(no_file);
  std::filesystem::copy_file(part, part_file(no_file));
  const Record record = read_record(part);
  EXPECT_THROW(write_whole_record(record, no_file), WriteError);
  const std::string told = to_string(test::issues_of([&] { write_whole_record(record, no_file); }));
  EXPECT_NE(told.find(no_file.string() + ": cannot write"), std::string::npos) << told;
  EXPECT_NE(told.find(part_file(no_file).string()), std::string::npos) << told;
}

/// Has a new phased goal in each step.
class PhasedStraight : public GoStraight {
 public:
  using GoStraight::GoStraight;
  NavigatorView view() const override {
    NavigatorView view = GoStraight::view();
    view.phased_goal = Vec2{1200, 900.0 + steps_};
    return view;
  }
  Command step(const Observation& seen, const Stop& stop) override {
    ++steps_;
    return GoStraight::step(seen, stop);
  }

 private:
  int steps_ = 0;
};

TEST(GrowingRecords, HaveThePhasedGoalsOfAnExternalNavigator) {
  const test::Folder folder;
  const auto part = folder / "run.part.h5";
  const Scenario scenario = long_flight();
  Session session(open_experiment(scenario, {}),
                  {.navigator = std::make_shared<PhasedStraight>(*scenario.goal, 60)});
  const GrowingRecord growing(session, folder / "run.h5", 1ms);
  ASSERT_TRUE(step_until(session, [&] { return std::filesystem::exists(part); }));
  const std::size_t frames = read_record(part).frames.size();
  ASSERT_TRUE(step_until(session, [&] { return read_record(part).frames.size() > frames; }));
  const Record record = read_record(part);
  const std::vector<PhasedGoal>& all = session.record().phased_goals;
  ASSERT_GT(record.phased_goals.size(), 0u);
  ASSERT_LE(record.phased_goals.size(), all.size());
  for (std::size_t i = 0; i < record.phased_goals.size(); ++i) {
    EXPECT_EQ(record.phased_goals[i].t, all[i].t) << i;
    EXPECT_EQ(record.phased_goals[i].point, all[i].point) << i;
  }
  EXPECT_EQ(record.phased_goals.back().t, record.frames.back().t);
}

TEST(GrowingRecords, ARunNeverFailsForThem) {
  const test::Folder folder;
  Session session(open_experiment(small_flight(), {}));
  const GrowingRecord growing(session, folder / "none/run.h5", 1ms);
  EXPECT_EQ(session.finish().status, Status::solved);
}

}  // namespace
}  // namespace microswarm::experiment
