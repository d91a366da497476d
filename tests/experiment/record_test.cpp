// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/record.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/replay.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/hdf5_image.hpp"
#include "microswarm/planning/common/detection.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::experiment {
namespace {

/// One flight for all tests here.
const Record& flight() {
  static const Record record = record_of(small_flight());
  return record;
}

// Pinned over everything but the navigator: noise, dead time, delay, watch, record.
TEST(Record, AStraightFlightIsTheSameBitsInEveryBuild) {
  Scenario scenario = small_flight();
  scenario.stop_at_contact = false;
  const Scene scene = load_scene(scenario, {});
  const World world = build_world(scene);
  KinematicPlant plant(scenario, world);
  GoStraight navigator(*scenario.goal, 60);
  Recorder recorder(scene);
  RunListener* const listeners[] = {&recorder};
  test::run(scenario, plant, navigator, listeners);
  EXPECT_EQ(recorder.record().hash(), "60fe8e7adc43bf4f");
}

TEST(Record, TheSmallFlightArrives) { EXPECT_EQ(flight().result.status, Status::solved); }

TEST(Record, ReadsBackToTheSameBits) {
  const auto file = empty_folder("record") / "flight.h5";
  write_record(flight(), file);
  const Record back = read_record(file);
  EXPECT_EQ(back.hash(), flight().hash());
  EXPECT_EQ(back.scene.hash(), flight().scene.hash());
  EXPECT_EQ(back.version, flight().version);
  EXPECT_EQ(back.result.status, flight().result.status);
  EXPECT_EQ(back.result.timing.steps, flight().result.timing.steps);
  EXPECT_EQ(back.frames.size(), flight().frames.size());
  EXPECT_EQ(back.plans.size(), flight().plans.size());
}

TEST(Record, TheSameRecordGivesTheSameBytes) {
  const auto folder = empty_folder("record_bytes");
  write_record(flight(), folder / "a.h5");
  write_record(flight(), folder / "b.h5");
  EXPECT_EQ(read_file(folder / "a.h5"), read_file(folder / "b.h5"));
}

// As programs wrote it that did not measure how long pictures wait.
TEST(Record, ARunOnARigWithoutLatenciesIsRead) {
  Record record = flight();
  record.rig = "bench";
  record.rig_log.began = "2026-01-01T00:00:00";
  record.rig_log.coils = {"x"};
  record.rig_log.driven_at = {0.1, 0.2};
  record.rig_log.currents = {0.5, 0.25};
  const auto file = empty_folder("record_rig") / "run.h5";
  write_record(record, file);
  const RigLog back = read_record(file).rig_log;
  EXPECT_EQ(back.driven_at, record.rig_log.driven_at);
  EXPECT_EQ(back.currents, record.rig_log.currents);
  EXPECT_TRUE(back.answered_at.empty());
  EXPECT_FALSE(back.latency);
}

TEST(Record, HashKnowsPhysicsAndNotClocks) {
  Record record = flight();
  for (double& s : record.result.timing.steps) s += 1;
  EXPECT_EQ(record.hash(), flight().hash());
  record.frames[3].pose.position.x = std::nextafter(record.frames[3].pose.position.x, 1e9);
  EXPECT_NE(record.hash(), flight().hash());
}

TEST(Record, KeepsTracksAndWalls) {
  Scenario scenario = small_flight();
  scenario.time_limit = 1;
  Scene scene = load_scene(scenario, {});
  const auto samples =
      std::make_shared<const Samples>(Samples{{0, 1, 2}, {{1, 2}, {3, 4}, {5, 6}}});
  scene.scenario.obstacles.push_back(disc(10, Track{"people.csv", "7", samples}));
  Recorder recorder(scene);
  const auto file = empty_folder("record_tracks") / "run.h5";
  write_record(recorder.record(), file);
  const Scene back = read_record(file).scene;
  EXPECT_EQ(back.hash(), scene.hash());
  EXPECT_EQ(std::get<Track>(back.scenario.obstacles.back().motion).samples->points[2],
            (Vec2{5, 6}));
  EXPECT_EQ(back.map.walls[0].outer, scene.map.walls[0].outer);
}

TEST(Record, ForeignBytesAreOneLine) {
  const auto folder = empty_folder("record_foreign");
  const auto message = [&](const std::string& bytes) {
    write_file_atomically(folder / "x.h5", bytes);
    const std::string what = error_of([&] { read_record(folder / "x.h5"); });
    EXPECT_EQ(what.find('\n'), std::string::npos);
    return what.substr(what.find("x.h5"));
  };
  EXPECT_EQ(message(""), "x.h5: no HDF5 file, or a damaged one");
  EXPECT_TRUE(test::is_one_line_naming(message("hello"), "x.h5", {"HDF5", "damaged"}));
  const Issues issues = test::issues_of([&] { read_record(folder / "x.h5"); });
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].location, (folder / "x.h5").string());
  EXPECT_EQ(message(std::string("SQLite format 3\0", 16)),
            "x.h5: the database of a sweep, no record: `microswarm export` writes its trials "
            "as a table");
  const auto made = io::write_hdf5();
  io::Hdf5Writer& other = *made;
  other.attribute("/", "format", "something else");
  EXPECT_TRUE(test::is_one_line_naming(message(other.finish()), "x.h5", {"microswarm", "record"}));

  write_record(flight(), folder / "whole.h5");
  const std::string whole = read_file(folder / "whole.h5");
  EXPECT_TRUE(test::is_one_line_naming(message(whole.substr(0, whole.size() / 2)), "x.h5",
                                       {"HDF5", "damaged"}));
}

// What is refused is refused in lines that name the file; what is read is a record like any
// other.
TEST(Record, DamagedBytesAreErrorsOrRecordsNeverCrashes) {
  const auto folder = empty_folder("record_damaged");
  const auto file = folder / "x.h5";
  write_record(flight(), file);
  const std::string whole = read_file(file);
  Rng rng(5, Purpose::test);
  int refused = 0;
  for (int i = 0; i < 60; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 4; ++k)
      bytes[rng.below(std::min<std::size_t>(bytes.size(), 40'000))] = static_cast<char>(rng.bits());
    write_file_atomically(file, bytes);
    std::optional<Record> read;
    const std::string error = error_of([&] { read = read_record(file); });
    if (!read) {
      ++refused;
      std::istringstream lines(error);
      for (std::string line; std::getline(lines, line);)
        EXPECT_TRUE(line.starts_with(file.string() + ":")) << i << ": " << line;
      continue;
    }
    const auto again = folder / "again.h5";
    write_record(*read, again);
    EXPECT_EQ(read_record(again).hash(), read->hash()) << i;
  }
  EXPECT_GT(refused, 5);
  EXPECT_LT(refused, 60);
}

// Made by the last version that had the navigator `predictive`.
TEST(Record, OfANavigatorThatIsGoneIsReadAndRepeated) {
  const auto source = std::filesystem::path(MICROSWARM_SOURCE_DIR);
  const Record record = read_record(source / "tests/experiment/predictive.h5");
  EXPECT_EQ(record.navigator, "predictive");
  EXPECT_EQ(record.hash(), record.stated_hash);
  EXPECT_EQ(replay(record).difference, "");
  const auto again = empty_folder("record_gone") / "again.h5";
  write_record(record, again);
  EXPECT_EQ(read_record(again).navigator, "predictive");
  EXPECT_EQ(replay(read_record(again)).difference, "");
}

TEST(Record, UnwritableFoldersAreOneLineAndLeaveNothing) {
  const auto folder = empty_folder("record_unwritable");
  const std::string what = error_of([&] { write_record(flight(), folder / "missing" / "run.h5"); });
  EXPECT_NE(what.find("run.h5: cannot write: "), std::string::npos) << what;
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  if (std::filesystem::exists("/dev/full")) {
    const std::string full = error_of([&] { write_record(flight(), "/dev/full"); });
    EXPECT_EQ(full, "/dev/full: cannot write: No space left on device");
  }
}

TEST(Record, ARunThatWasStoppedIsWhole) {
  const Scene scene = load_scene(small_flight(), {});
  struct StopAt : RunListener {
    std::atomic<bool> flag{false};
    int frames = 0;
    void on_tick(const Tick&) override {
      if (++frames == 20) flag = true;
    }
  } stop_at;
  Session session({scene, build_world(scene), {}});
  session.listen(stop_at);
  session.finish(Stop(&stop_at.flag));
  EXPECT_EQ(session.record().result.status, Status::stopped);
  EXPECT_EQ(session.record().frames.size(), 21u);
  const ReplayResult again = replay(session.record());
  EXPECT_TRUE(again.identical) << again.difference;
}

TEST(Replay, ARecordRepeats) {
  const auto file = empty_folder("replay") / "flight.h5";
  write_record(flight(), file);
  const ReplayResult again = replay(read_record(file));
  EXPECT_TRUE(again.identical) << again.difference;
}

TEST(Replay, ATamperedRecordSaysWhere) {
  Record record = flight();
  record.frames[12].pose.position.y = 501.25;
  ReplayResult again = replay(record);
  EXPECT_FALSE(again.identical);
  EXPECT_EQ(again.difference.rfind("frame 12 (t = 1.2", 0), 0u) << again.difference;
  EXPECT_NE(again.difference.find("y_um is 501.25 in the record, "), std::string::npos);

  record = flight();
  record.result.metrics.contacts = 3;
  EXPECT_EQ(replay(record).difference, "metrics: contacts is 3 in the record, 0 in the replay");

  record = flight();
  record.scene.scenario.seed += 1;
  EXPECT_FALSE(replay(record).identical);
}

TEST(Replay, StopsWhenTold) {
  const std::atomic<bool> flag{true};
  EXPECT_TRUE(replay(flight(), Stop(&flag)).stopped);
}

TEST(RecordLayout, TheDocsNameEveryQuantity) {
  std::ifstream in(std::string(MICROSWARM_SOURCE_DIR) + "/docs/reference/record.md");
  ASSERT_TRUE(in);
  std::stringstream text;
  text << in.rdbuf();
  const std::string docs = text.str();
  const auto expect = [&docs](const auto& columns) {
    for (const auto& column : columns)
      EXPECT_NE(docs.find(column.key + "`"), std::string::npos) << column.key;
  };
  expect(io::to_columns<Frame>());
  expect(io::to_columns<PathChange>());
  expect(io::to_columns<PlanEvent>());
  expect(io::to_columns<RunEvent>());
  expect(io::to_columns<TreeNode>());
  expect(io::to_columns<Detection>());
}

TEST(Record, H5pyReadsIt) {
  std::string python;
  for (const std::string candidate : {"/usr/bin/python3", "python3"})
    if (std::system((candidate + " -c 'import h5py' > /dev/null 2>&1").c_str()) == 0)
      python = candidate;
  if (python.empty()) GTEST_SKIP() << "python3-h5py is not installed";
  const auto file = empty_folder("record_h5py") / "flight.h5";
  write_record(flight(), file);
  const std::string command = python + " " + MICROSWARM_SOURCE_DIR +
                              "/tests/experiment/read_record.py " + file.string() + " " +
                              std::to_string(flight().frames.size()) + " " + flight().hash();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace microswarm::experiment
