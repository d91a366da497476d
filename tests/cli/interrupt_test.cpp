// SPDX-License-Identifier: Apache-2.0
// Ctrl-C, kill -9, and two at once.
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "inputs.hpp"
#include "program.hpp"
#include "terminal.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

constexpr double max_seconds = 20;  // a busy computer draws a report for some; a hang is longer

/// Takes minutes: a slow swarm at a thousand ticks a second.
std::string endless() {
  return with(with(two_rooms(), "max_speed", "  max_speed_um_per_s: 1"), "time_limit",
              "time_limit_s: 10000\ntick_s: 0.001");
}

class Interrupted : public CommandLine {
 protected:
  /// Ends the program with a signal and waits; the seconds it took to end.
  static double end_with(Program& program, int signal, Outcome& outcome) {
    const auto began = std::chrono::steady_clock::now();
    program.send(signal);
    outcome = program.wait();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  }
  /// No file under a name that is not its last, whoever wrote it.
  void expect_no_temporary_files() const {
    for (const std::string& name : files())
      EXPECT_EQ(name.find(".tmp-"), std::string::npos) << name;
  }
};

TEST_F(Interrupted, CtrlCKeepsWhatThereIs) {
  write("flight.yaml", endless());
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program({"run", "flight.yaml", "--out", "out", "--json"}, at);
    program.let_work(500);
    ASSERT_TRUE(program.running());
    Outcome outcome;
    EXPECT_LT(end_with(program, signal, outcome), max_seconds);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(Json::parse(outcome.out).at("status"), "stopped");
    EXPECT_TRUE(exists("out/index.html"));
    expect_no_temporary_files();
    EXPECT_TRUE(good({"replay", "out/run.h5"}).starts_with("identical: record "));
    fs::remove_all(at.folder / "out");
  }
}

// `timeout` sends it to the process and to its group; a second Ctrl-C by hand comes later.
TEST_F(Interrupted, TheSameCtrlCTwiceIsOne) {
  write("flight.yaml", endless());
  Program program({"run", "flight.yaml", "--out", "out"}, at);
  program.let_work(500);
  ASSERT_TRUE(program.running());
  program.send(SIGINT);
  program.let_work(1);
  Outcome outcome;
  EXPECT_LT(end_with(program, SIGINT, outcome), max_seconds);
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_TRUE(exists("out/run.h5"));
}

TEST_F(Interrupted, APlanThatWasCutShortIsToldByItsCode) {
  write("map.csv", "0,0,1,1\n1999,999,1,1\n");
  Program program({"plan", "map.csv", "--start", "100,500", "--goal", "1900,500", "--set",
                   "planner.type=rrt_star", "--set", "planner.stop_at_first=false", "--set",
                   "planner.max_nodes=10000000", "--set", "planner.max_iterations=100000000"},
                  at);
  program.let_work(500);
  ASSERT_TRUE(program.running());
  Outcome outcome;
  EXPECT_LT(end_with(program, SIGINT, outcome), max_seconds);
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
}

/// Output and errors can no longer be written then, and the progress bar was on that terminal.
TEST_F(Interrupted, AClosedTerminalEndsItWithEverythingKept) {
  write("flight.yaml", endless());
  Terminal terminal({"run", "flight.yaml", "--out", "out"}, at);
  ASSERT_TRUE(terminal.hears("%"));
  terminal.hang_up();
  EXPECT_EQ(terminal.wait(), 3);
  EXPECT_TRUE(exists("out/index.html"));
  expect_no_temporary_files();
}

TEST_F(Interrupted, TheFirstCtrlCEndsTheReadingOfAMap) {
  std::string map = R"({"type":"FeatureCollection","features":[)";
  for (int i = 0; i < 100'000; ++i) {
    const std::string x = std::to_string(20 * i), y = std::to_string(20 * i + 8);
    map += std::string(i > 0 ? "," : "") +
           R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[)" +
           x + ",0],[" + y + ",0],[" + y + ",8],[" + x + ",0]]]}}";
  }
  write("map.geojson", map + "]}");
  Program program({"map", "info", "map.geojson"}, at);
  program.let_work(300);
  ASSERT_TRUE(program.running());
  Outcome outcome;
  EXPECT_LT(end_with(program, SIGINT, outcome), 0.5 * max_seconds);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.out, "");
}

TEST_F(Interrupted, CtrlCWithoutOutLeavesNothing) {
  write("flight.yaml", endless());
  Program program({"run", "flight.yaml"}, at);
  program.let_work(300);
  Outcome outcome;
  EXPECT_LT(end_with(program, SIGINT, outcome), max_seconds);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(outcome.out.starts_with("stopped after ")) << outcome.out;
  EXPECT_EQ(files(), std::set<std::string>{"flight.yaml"});
}

TEST_F(Interrupted, CtrlCEndsTrialsReplayAndReproduce) {
  write("flight.yaml", endless());
  const auto ends = [&](const Arguments& arguments) {
    Program program(arguments, at);
    program.let_work(300);
    EXPECT_TRUE(program.running()) << arguments[0];
    Outcome outcome;
    EXPECT_LT(end_with(program, SIGINT, outcome), max_seconds) << arguments[0];
    EXPECT_EQ(outcome.code, 3) << arguments[0] << outcome.err;
    EXPECT_EQ(outcome.err, "");
  };
  ends({"run", "flight.yaml", "--trials", "8", "--jobs", "2", "--out", "out"});
  ends({"reproduce", "drrt", "--out", "drrt"});
  Program program({"run", "flight.yaml", "--out", "out", "--no-report"}, at);
  program.let_work(1500);
  program.send(SIGINT);
  program.wait();
  ends({"replay", "out/run.h5"});
  expect_no_temporary_files();
}

TEST_F(Interrupted, KilledLeavesNoHalfRecord) {
  write("flight.yaml", two_rooms());
  for (int ms = 20; ms <= 600; ms = ms * 3 / 2) {
    fs::remove_all(at.folder / "out");
    Program program({"run", "flight.yaml", "--out", "out"}, at);
    sleep_ms(ms);
    program.send(SIGKILL);
    program.wait();
    if (!exists("out/run.h5")) continue;
    EXPECT_TRUE(good({"replay", "out/run.h5"}).starts_with("identical: record ")) << ms;
  }
}

TEST_F(Interrupted, TwoIntoOneFolder) {
  write("flight.yaml", two_rooms());
  write("endless.yaml", endless());
  Program first({"run", "endless.yaml", "--out", "out", "--no-report"}, at);
  first.let_work(1000);
  for (const Arguments& second : std::vector<Arguments>{{"run", "flight.yaml", "--out", "out"},
                                                        {"reproduce", "drrt", "--out", "out"}})
    refused(second, "out: another command is writing to it");
  Outcome outcome;
  end_with(first, SIGINT, outcome);
  EXPECT_TRUE(exists("out/run.h5"));
  good({"run", "flight.yaml", "--out", "out"});  // the folder is free again
  EXPECT_TRUE(good({"replay", "out/run.h5"}).starts_with("identical: record "));
  expect_no_temporary_files();
}

}  // namespace
}  // namespace microswarm::test
