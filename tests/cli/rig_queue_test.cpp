// SPDX-License-Identifier: Apache-2.0
// `rig queue` as a person runs it: a power cut, a driver that hangs, Ctrl-C, two at once.
#include <nlohmann/json.hpp>

#include "driven_rig.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "notices.hpp"
#include "terminal.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

class RigQueue : public DrivenRig {
 protected:
  RigQueue() {
    write_rig(device);
    write("queue.yaml",
          "time_budget_s: 2.5\nentries:\n  - {scenario: flight.yaml, name: one}\n"
          "  - {scenario: flight.yaml, name: two, set: ['goal_um=[1400, 500]']}\n"
          "  - {scenario: flight.yaml, name: three, set: ['goal_um=[1300, 500]']}\n");
  }
  static Arguments queue(const Arguments& more = {}) {
    Arguments all{"rig",          "queue",         "queue.yaml",   "--rig", "rig.yaml",
                  "--other-stop", "--drawn-swarm", "--coils-cold", "--out", "out"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Json state() const {
    const Outcome outcome = run({"rig", "queue", "--status", "out", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }
  std::vector<std::string> states() const {
    std::vector<std::string> all;
    const Json queue = state();
    for (const Json& item : queue.at("items")) all.push_back(item.at("state"));
    return all;
  }
  /// Until a file is there; a run writes its record so far after some seconds.
  void wait_for(const std::string& file) const {
    for (int i = 0; i < 3000 && !exists(file); ++i) sleep_ms(10);
    EXPECT_TRUE(exists(file)) << file;
  }
  /// Until the coils are driven: a log has its header from before the checks on.
  void let_drive(const std::string& folder) const {
    const std::string log = folder + "/commands.csv.part";
    wait_for(log);
    for (int i = 0; i < 3000 && read(log).find("driven") == std::string::npos; ++i) sleep_ms(10);
  }
  void expect_zero(const std::string& folder) const {
    const std::string log = read(folder + "/commands.csv");
    EXPECT_TRUE(names(log.substr(log.rfind('\n', log.size() - 2) + 1), "zero")) << log;
  }
  std::atomic<bool> is_silent = false;
  FakeDevice device{[this](actuation::CoilReply&) { return !is_silent; }};
  using Names = std::vector<std::string>;
};

TEST_F(RigQueue, GoesOnAfterAPowerCutAndRunsNothingTwice) {
  {
    Program program(queue({"--set-rig", "drive_rate_hz=100"}), at);
    let_drive("out/002-two-1");
    program.send(SIGKILL);
    EXPECT_EQ(program.wait().signal, SIGKILL);
  }
  const Json cut = state();
  EXPECT_FALSE(cut.at("active"));
  EXPECT_EQ(cut.at("items")[1].at("state"), "running");
  const std::string first = read("out/001-one-1/run.h5");

  const Outcome outcome = run(queue());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "002-two-1: was interrupted")) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "--coils-cold counts where a queue begins")) << outcome.err;
  EXPECT_EQ(states(), (Names{"done", "done", "done"}));
  EXPECT_EQ(read("out/001-one-1/run.h5"), first);
  EXPECT_TRUE(exists("out/002-two-1/commands.csv.part"));
  for (const char* folder : {"out/001-one-1", "out/002-two-1-attempt2", "out/003-three-1"}) {
    EXPECT_FALSE(experiment::read_record(at.folder / folder / "run.h5").frames.empty()) << folder;
    EXPECT_TRUE(Json::parse(read(std::string(folder) + "/result.json")).contains("rig_timing"));
    expect_zero(folder);
  }
  const std::string csv = read("out/summary.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 5) << csv;
  EXPECT_TRUE(names(csv, "interrupted")) << csv;
  EXPECT_TRUE(names(csv, "time budget")) << csv;

  const Outcome again = run(queue());
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read("out/summary.csv"), csv);
  EXPECT_TRUE(names(run({"rig", "queue", "--status", "out"}).out, "3 of 3 done"));
}

TEST_F(RigQueue, ADriverThatHangsStopsItAndCallsAPerson) {
  write("told.sh",
        "#!/bin/sh\nprintf '%s\\n' \"$MICROSWARM_FAULT\" \"$MICROSWARM_RECORD\" >>told\n");
  fs::permissions(at.folder / "told.sh", fs::perms::owner_all);
  Program program(queue({"--set-rig", "safety.on_fault=[./told.sh]"}), at);
  let_drive("out/002-two-1");
  is_silent = true;
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  ASSERT_TRUE(exists("told")) << outcome.err;
  EXPECT_TRUE(names(read("told"), "002-two-1: the coil driver does not answer")) << read("told");
  EXPECT_TRUE(names(read("told"), "the queue has stopped")) << read("told");
  EXPECT_EQ(states(), (Names{"done", "waiting", "waiting"}));
  is_silent = false;  // somebody has mended it
  EXPECT_EQ(run(queue()).code, 0);
  EXPECT_EQ(states(), (Names{"done", "done", "done"}));
}

TEST_F(RigQueue, ARigThatIsEditedInTheNightStopsItForAPerson) {
  const std::string rig = read("rig.yaml");
  {
    Program program(queue(), at);
    let_drive("out/001-one-1");
    write("rig.yaml", rig + "# a comment\n");
    let_drive("out/002-two-1");
    write("rig.yaml", rig + "delay_s: 0.1\n");
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_TRUE(names(outcome.err, "rig.yaml or its coils have changed since the queue began"))
        << outcome.err;
  }
  EXPECT_EQ(states(), (Names{"done", "done", "waiting"}));
  EXPECT_EQ(state().at("items")[2].at("attempts")[0].at("fault"), "person");
  // A person who starts it again agrees, and is reminded.
  const Outcome again = run(queue());
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(names(again.err, "rig.yaml or its coils have changed since the queue ran"))
      << again.err;
}

TEST_F(RigQueue, CtrlCEndsItAtZeroWithItsState) {
  Program program(queue(), at);
  let_drive("out/001-one-1");
  EXPECT_TRUE(state().at("active"));
  const Outcome second = run(queue());
  EXPECT_EQ(second.code, 2);
  EXPECT_TRUE(is_one_line_naming(second.err, "", {"out", "another command is writing to it"}))
      << second.err;
  program.send(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_EQ(states(), (Names{"waiting", "waiting", "waiting"}));
  expect_zero("out/001-one-1");
}

TEST_F(RigQueue, TheManagerOfServicesHearsWhatItDoes) {
  const Notices manager((at.folder / "notices").string());
  manager.ask(at, 1000);
  Program program(queue(), at);
  ASSERT_TRUE(manager.hears("READY=1"));
  EXPECT_TRUE(manager.hears("the coils are driven"));
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  EXPECT_TRUE(manager.hears("the coils are not driven"));
  EXPECT_TRUE(manager.hears("STOPPING=1"));
  EXPECT_EQ(program.wait().code, 0);
}

TEST_F(RigQueue, HotCoilsAreWaitedForAndAWaitWithoutEndIsRefused) {
  write("queue.yaml",
        "start_below_degc: 89.5\nentries: [{scenario: flight.yaml, time_budget_s: 1}]\n");
  Arguments unknown = queue();
  std::erase(unknown, "--coils-cold");
  const Outcome outcome = run(unknown);  // nothing is known: they are at their limit, 90 °C
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "cooling: coil x 90.0 °C, 89.5 °C in about 3 s")) << outcome.err;
  write("queue.yaml", "entries: [{scenario: flight.yaml, start_below_degc: 20}]\n");
  refused(queue(), naming("queue.yaml:1:53", {"20", "ambient"}));
}

TEST_F(RigQueue, KeysEndIt) {
  Arguments words = queue();
  std::erase(words, "--other-stop");
  std::erase(words, "--coils-cold");
  for (const auto& [key, code] : {std::pair{"q", 3}, {" ", 4}}) {
    Terminal terminal(words, at);  // the coils are taken at their limit, and cool for minutes
    ASSERT_TRUE(terminal.hears("cooling: coil"));
    ASSERT_TRUE(terminal.hears("cooling: coil"));  // in its status line
    terminal.press(key);
    EXPECT_EQ(terminal.wait(), code) << terminal.said();
  }
  fs::remove_all(at.folder / "out");
  fs::remove_all(at.folder / ".state");
  words.emplace_back("--coils-cold");
  Terminal terminal(words, at);
  ASSERT_TRUE(terminal.hears("coils to zero at once"));
  let_drive("out/001-one-1");
  terminal.press(" ");
  EXPECT_EQ(terminal.wait(), 4) << terminal.said();
  EXPECT_EQ(states(), (Names{"waiting", "waiting", "waiting"}));
  expect_zero("out/001-one-1");
}

TEST_F(RigQueue, WhatIsMissingIsNamed) {
  refused({"rig", "queue", "--rig", "rig.yaml", "--out", "o"}, naming("", {"queue is missing"}));
  refused({"rig", "queue", "queue.yaml", "--out", "o"}, naming("", {"--rig"}));
  refused({"rig", "queue", "queue.yaml", "--rig", "rig.yaml"}, naming("", {"--out"}));
  refused({"rig", "queue", "--status", "."}, naming(".", {"no queue"}));
}

}  // namespace
}  // namespace microswarm::test
