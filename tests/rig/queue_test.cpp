// SPDX-License-Identifier: Apache-2.0
// A queue of runs: its file, its rules, and what it does after faults, without a rig.
#include <gtest/gtest.h>

#include <map>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/rig/queue/cool_down.hpp"
#include "microswarm/rig/queue/run_queue.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

class QueueTest : public testing::Test {
 protected:
  QueueTest() {
    folder.with("coils.yaml",
                "coils: {type: helmholtz}\n"
                "drives:\n  - {thermal_resistance_k_per_w: 2.5, thermal_time_s: 400, "
                "max_current_a: 10, max_temperature_degc: 90}\n");
    folder.with("rig.yaml", "coils: coils.yaml\n");
    for (const char* name : {"a.yaml", "b.yaml", "c.yaml"}) folder.with(name, scenario());
  }
  static std::string scenario(int goal = 1500) {
    return fmt::format(
        "map: {{type: polygons, lo_um: [0, 0], hi_um: [2000, 1000]}}\n"
        "start: {{x_um: 400, y_um: 500}}\ngoal_um: [{}, 500]\ntime_limit_s: 60\n"
        "swarm: {{type: vortex, max_speed_um_per_s: 20}}\nnavigator: {{type: radar, "
        "speed_um_per_s: 20}}\n",
        goal);
  }
  fs::path with_queue(const std::string& text) { return folder.with("queue.yaml", text); }
  Queue open(const std::string& text) {
    return open_queue(with_queue(text), folder / "rig.yaml", {});
  }
  /// Runs a queue; `results` are those of the items' attempts, in turn, done otherwise.
  QueueEnd run(const Queue& queue) {
    const Rig rig = read_rig(folder / "rig.yaml");
    return run_queue(queue, rig, "rig.yaml", out(), host);
  }
  fs::path out() const {
    fs::create_directories(folder / "out");
    return folder / "out";
  }
  QueueState state() const { return read_queue_state(folder / "out").value(); }
  static AttemptResult faulty(FaultKind kind, const std::string& why = "it broke") {
    return {.end = AttemptEnd::fault, .fault = kind, .reason = why};
  }

  test::Folder folder;
  std::map<std::string, std::vector<AttemptResult>> results;  // by item
  std::vector<std::string> ran, told, alarms;
  double time = 1e9;
  double free = 1e12;
  bool stopped = false;
  std::string halted;
  std::optional<Eigen::VectorXd> temperatures;
  QueueHost host{
      .run =
          [this](const QueueItem& item, const fs::path& at) {
            fs::create_directories(at);
            ran.push_back(at.filename().string());
            time += 10;
            std::vector<AttemptResult>& of = results[item.name];
            if (of.empty()) return AttemptResult{.status = "goal reached"};
            const AttemptResult result = of.front();
            of.erase(of.begin());
            return result;
          },
      .temperatures = [this] { return temperatures; },
      .wall = [this] { return time; },
      .clock = [this] { return time; },
      .wait = [this](double seconds) { time += seconds; },
      .stops = [this] { return stopped; },
      .halts = [this] { return halted; },
      .free_space = [this](const fs::path&) { return free; },
      .tell = [this](const std::string& line) { told.push_back(line); },
      .doing = [](const std::string&) {},
      .alarm = [this](const std::string& why, const fs::path&) { alarms.push_back(why); }};
};

using Names = std::vector<std::string>;

TEST_F(QueueTest, AFolderIsRunByName) {
  fs::create_directories(folder / "night");
  for (const char* name : {"20-b.yaml", "10-a.yaml"})
    fs::copy(folder / "a.yaml", folder / "night" / name);
  const Queue queue = open_queue(folder / "night", folder / "rig.yaml", {});
  EXPECT_EQ(run(queue), QueueEnd::complete);
  EXPECT_EQ(ran, (Names{"001-10-a-1", "002-20-b-1"}));
  EXPECT_EQ(queue.items.front().time_budget, 60);
}

TEST_F(QueueTest, RepeatsInOrderAndOwnRulesBeforeTheCommonOnes) {
  const Queue queue = open(
      "time_budget_s: 20\nset: [time_limit_s=30]\nentries:\n"
      "  - {scenario: a.yaml, repeat: 2}\n  - {scenario: a.yaml, name: x, time_budget_s: 5, "
      "set: [time_limit_s=40]}\n");
  EXPECT_EQ(run(queue), QueueEnd::complete);
  EXPECT_EQ(ran, (Names{"001-a-1", "002-a-2", "003-x-1"}));
  EXPECT_EQ(queue.items[0].time_budget, 20);
  EXPECT_EQ(queue.items[2].time_budget, 5);
  EXPECT_EQ(queue.items[0].start_below, std::vector<double>(3, 56));  // between 22 and 90 °C
  const std::string csv = read_file(folder / "out/summary.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 4) << csv;
}

TEST_F(QueueTest, TheSwarmMayBeAnywhereUnlessItsRuleSaysOtherwise) {
  const Queue queue = open("entries: [{scenario: a.yaml}, {scenario: b.yaml, anywhere: false}]\n");
  const auto may_be_anywhere = [&](const QueueItem& item) {
    return open_item(item, folder / "rig.yaml", {}).rig.params.perception.start_anywhere;
  };
  EXPECT_TRUE(may_be_anywhere(queue.items[0]));
  EXPECT_FALSE(may_be_anywhere(queue.items[1]));
}

TEST_F(QueueTest, MistakesAreToldBeforeAnythingRuns) {
  const auto refused = [&](const std::string& text, const std::string& key) {
    const std::string what = test::error_of([&] { open(text); });
    EXPECT_TRUE(test::names(what, key)) << what;
  };
  refused("entries: []\n", "empty");
  refused("entries: [{scenario: a.yaml, repaet: 2}]\n", "repaet");
  refused("entries: [{scenario: none.yaml}]\n", "none.yaml");
  refused("entries: [{scenario: a.yaml, set: [goal_um=3]}]\n", "goal_um");
  refused("entries: [{scenario: a.yaml, name: a/b}]\n", "a/b");
  refused("until: 25:00\nentries: [{scenario: a.yaml}]\n", "HH:MM");
  refused("full_disk: pause\nentries: [{scenario: a.yaml}]\n", "hours");
  refused("start_below_degc: 22\nentries: [{scenario: a.yaml}]\n", "ambient");
  refused("entries: [{scenario: a.yaml, start_below_degc: 91}]\n", "90");
  refused(scenario(), "queue");
}

TEST_F(QueueTest, TheCoilsCoolDownBeforeEachRun) {
  temperatures = Eigen::Vector3d(61.2, 30, 30);
  const Queue queue = open("start_below_degc: 45\nentries: [{scenario: a.yaml}]\n");
  const double began = time;
  EXPECT_EQ(run(queue), QueueEnd::complete);
  EXPECT_NEAR(time - began, 10 + 400 * std::log(39.2 / 23), 1.5);
  EXPECT_TRUE(test::names(told.front(), "cooling: coil x 61.2 °C, 45 °C in about 3.6 min"))
      << told.front();
}

TEST_F(QueueTest, AFaultIsTriedAgainOrLeftAsItsRuleSays) {
  results["a"] = {faulty(FaultKind::swarm), faulty(FaultKind::camera)};
  results["b"] = {faulty(FaultKind::swarm)};
  results["c"] = {faulty(FaultKind::computer)};
  const Queue queue = open(
      "entries:\n  - {scenario: a.yaml, on_fault: retry, retries: 2}\n  - {scenario: b.yaml}\n"
      "  - {scenario: c.yaml, on_fault: retry}\n");
  EXPECT_EQ(run(queue), QueueEnd::incomplete);
  EXPECT_EQ(ran, (Names{"001-a-1", "001-a-1-attempt2", "001-a-1-attempt3", "002-b-1", "003-c-1",
                        "003-c-1-attempt2"}));
  EXPECT_EQ(state().items[0].state, ItemState::done);
  EXPECT_EQ(state().items[1].state, ItemState::failed);
  EXPECT_EQ(alarms.size(), 4u);
  EXPECT_TRUE(test::names(alarms.back(), "the queue goes on"));
  // What is done or has failed is not run again.
  ran.clear();
  EXPECT_EQ(run(queue), QueueEnd::incomplete);
  EXPECT_TRUE(ran.empty());
}

TEST_F(QueueTest, AFaultThatNeedsAPersonStopsItAndTheSameGoesOn) {
  const Queue queue = open("entries: [{scenario: a.yaml, on_fault: skip}, {scenario: b.yaml}]\n");
  for (const FaultKind kind : {FaultKind::device, FaultKind::person, FaultKind::disk}) {
    results["a"] = {faulty(kind, "it is gone")};
    EXPECT_EQ(run(queue), QueueEnd::needs_person);
    EXPECT_TRUE(test::names(alarms.back(), "it is gone; the queue has stopped"));
    EXPECT_EQ(state().items[0].state, ItemState::waiting);
  }
  EXPECT_EQ(run(queue), QueueEnd::complete);
  EXPECT_EQ(state().items[0].attempts.size(), 4u);
  EXPECT_EQ(ran.back(), "002-b-1");
}

TEST_F(QueueTest, ManyFaultsInARowStopIt) {
  results["a"] = std::vector(9, faulty(FaultKind::swarm));
  EXPECT_EQ(run(open("faults_in_a_row: 4\nentries: [{scenario: a.yaml, repeat: 9}]\n")),
            QueueEnd::needs_person);
  EXPECT_EQ(ran.size(), 4u);
  EXPECT_TRUE(test::names(alarms.back(), "attempt 4 in a row")) << alarms.back();
}

TEST_F(QueueTest, ARefusedRunFailsAndTheNextFollows) {
  results["a"] = {{.end = AttemptEnd::refused, .reason = "the start is outside"}};
  EXPECT_EQ(run(open("entries: [{scenario: a.yaml}, {scenario: b.yaml}]\n")), QueueEnd::incomplete);
  EXPECT_EQ(ran.size(), 2u);
  EXPECT_EQ(state().items[0].note, "the start is outside");
  EXPECT_TRUE(test::names(alarms.front(), "the queue goes on"));
}

TEST_F(QueueTest, WhatWouldEndTooLateIsLeftOut) {
  const Queue queue = open(
      "hours: 0.01\nentries: [{scenario: a.yaml, time_budget_s: 20}, {scenario: b.yaml, "
      "time_budget_s: 30}, {scenario: c.yaml, time_budget_s: 10}]\n");
  EXPECT_EQ(run(queue), QueueEnd::incomplete);  // 36 s
  EXPECT_EQ(ran, (Names{"001-a-1", "003-c-1"}));
  EXPECT_TRUE(test::names(state().items[1].note, "no time left"));
  EXPECT_EQ(
      std::ranges::count_if(told, [](const auto& line) { return test::names(line, "left out"); }),
      1);
}

TEST_F(QueueTest, RefusalsInARowCallAPerson) {
  const AttemptResult refusal{.end = AttemptEnd::refused, .reason = "the camera is displaced"};
  results["a"] = {faulty(FaultKind::camera), refusal, refusal};
  const Queue queue = open("entries: [{scenario: a.yaml, repeat: 60}]\n");
  EXPECT_EQ(run(queue), QueueEnd::needs_person);
  EXPECT_EQ(ran.size(), 3u);
  EXPECT_EQ(state().count(ItemState::waiting), 57);
  ASSERT_FALSE(alarms.empty());
  EXPECT_TRUE(test::names(alarms.back(), "3 in a row")) << alarms.back();
}

TEST_F(QueueTest, AStateThatIsALinkOrHasNoDateIsRefusedWithoutItsContent) {
  const Queue queue = open("entries: [{scenario: a.yaml}]\n");
  folder.with("secret", "secret: words\n");
  fs::create_symlink(folder / "secret", queue_state_file(out()));
  const std::string linked = test::error_of([&] { run(queue); });
  EXPECT_TRUE(test::names(linked, queue_state_file(out()).string())) << linked;
  EXPECT_FALSE(test::names(linked, "words")) << linked;
  EXPECT_EQ(read_file(folder / "secret"), "secret: words\n");
  fs::remove(queue_state_file(out()));
  write_file_atomically(queue_state_file(out()), "began_s: 1e30\n");
  EXPECT_TRUE(test::names(test::error_of([&] { run(queue); }), "began_s"));
  EXPECT_TRUE(ran.empty());
}

TEST_F(QueueTest, ItsEndIsTheNextTimeOfThatName) {
  QueueParams params;
  EXPECT_FALSE(queue_end(params, 1e9, 1e9));
  params.until = "07:30";
  const double end = queue_end(params, 1e9, 1e9).value();
  EXPECT_GT(end, 1e9);
  EXPECT_LE(end, 1e9 + 25 * 3600);
  const auto then = static_cast<std::time_t>(end);
  EXPECT_EQ(std::localtime(&then)->tm_hour, 7);
  EXPECT_EQ(std::localtime(&then)->tm_min, 30);
  params.hours = 0.001;
  EXPECT_EQ(queue_end(params, 1e9, 1e9), 1e9 + 3.6);
}

TEST_F(QueueTest, ALaterNightHasItsOwnEndAndAPowerCutHasNot) {
  const Queue queue = open("entries: [{scenario: a.yaml, repeat: 2}]\nuntil: '07:30'\n");
  constexpr double days = 2 * 86400;
  results["a"] = {{.status = "goal reached"}, {.end = AttemptEnd::stopped}};
  EXPECT_EQ(run(queue), QueueEnd::stopped);
  QueueState cut = state();
  time += days;
  cut.active = true;  // as a killed program leaves it
  write_queue_state(out(), cut);
  EXPECT_EQ(run(queue), QueueEnd::incomplete);
  EXPECT_EQ(ran.size(), 2u);
  EXPECT_EQ(run(queue), QueueEnd::complete);
  EXPECT_EQ(ran.size(), 3u);
}

TEST_F(QueueTest, AFullDiskIsFoundBeforeARun) {
  free = 1e5;
  const Queue queue = open("entries: [{scenario: a.yaml}]\n");
  EXPECT_EQ(run(queue), QueueEnd::needs_person);
  EXPECT_TRUE(ran.empty());
  ASSERT_FALSE(alarms.empty());
  EXPECT_TRUE(test::names(alarms.back(), "0 MB are free")) << alarms.back();
  free = 1e12;
  EXPECT_EQ(run(queue), QueueEnd::complete);
}

TEST_F(QueueTest, OrItWaitsForSpace) {
  free = 1e5;
  host.wait = [&, began = time](double seconds) {
    time += seconds;
    if (time > began + 600) free = 1e12;
  };
  const double began = time;
  EXPECT_EQ(run(open("full_disk: pause\nhours: 1\nentries: [{scenario: a.yaml}]\n")),
            QueueEnd::complete);
  EXPECT_NEAR(time - began, 610, 2);
}

TEST_F(QueueTest, AStopDuringACoolDownKeepsItsPlace) {
  temperatures = Eigen::Vector3d(80, 30, 30);
  stopped = true;
  const Queue queue = open("entries: [{scenario: a.yaml}]\n");
  EXPECT_EQ(run(queue), QueueEnd::stopped);
  stopped = false;
  halted = "the emergency key was pressed";
  EXPECT_EQ(run(queue), QueueEnd::needs_person);
  EXPECT_TRUE(ran.empty());
  halted.clear();
  EXPECT_EQ(run(queue), QueueEnd::complete);
}

TEST_F(QueueTest, AStoppedRunIsRunAgain) {
  results["a"] = {{.end = AttemptEnd::stopped}};
  const Queue queue = open("entries: [{scenario: a.yaml}, {scenario: b.yaml}]\n");
  EXPECT_EQ(run(queue), QueueEnd::stopped);
  EXPECT_EQ(run(queue), QueueEnd::complete);
  EXPECT_EQ(ran, (Names{"001-a-1", "001-a-1-attempt2", "002-b-1"}));
}

TEST_F(QueueTest, AnInterruptedRunIsTriedAgainButNotForEver) {
  const Queue queue = open("interruptions: 1\nentries: [{scenario: a.yaml}, {scenario: b.yaml}]\n");
  const auto interrupt = [&] {
    QueueState now = read_queue_state(out()).value_or(
        merge_state(queue, std::nullopt, out(), [](const std::string&) {}));
    const std::string at = fmt::format("001-a-1{}", now.items[0].attempts.empty() ? "" : "-x");
    fs::create_directories(out() / at);
    write_file_atomically(out() / at / "run.part.h5", "");
    now.items[0].state = ItemState::running;
    now.items[0].attempts.push_back({.folder = at});
    write_queue_state(out(), now);
  };
  interrupt();
  results["a"] = {faulty(FaultKind::device)};
  EXPECT_EQ(run(queue), QueueEnd::needs_person);
  EXPECT_EQ(state().items[0].attempts[0].end, AttemptEnd::interrupted);
  EXPECT_TRUE(test::names(state().items[0].attempts[0].reason, "001-a-1/run.part.h5"));
  interrupt();
  EXPECT_EQ(run(queue), QueueEnd::incomplete);
  EXPECT_EQ(state().items[0].note, "was interrupted 2 times");
  EXPECT_EQ(ran.back(), "002-b-1");
}

TEST_F(QueueTest, CommentsInTheRigsFileDoNotChangeIt) {
  const auto hash = [&](const Settings& settings = {}) {
    return rig_hash(read_rig(folder / "rig.yaml", settings));
  };
  const std::string before = hash();
  folder.with("rig.yaml", "# bench 2\ncoils:   coils.yaml\n");
  EXPECT_EQ(hash(), before);
  EXPECT_NE(hash({std::vector<std::string>{"delay_s=0.1"}, "--set-rig"}), before);
  folder.with("coils.yaml",
              "coils: {type: helmholtz}\ndrives:\n  - {thermal_resistance_k_per_w: 2.4, "
              "thermal_time_s: 400, max_current_a: 10, max_temperature_degc: 90}\n");
  EXPECT_NE(hash(), before);
}

TEST_F(QueueTest, AGridThatChangesAwayFromItsCentreIsAnotherRig) {
  const auto grid = [&](int axis, double more) {
    std::string text = "8\n2 2 2\n-0.01 0.01\n-0.01 0.01\n-0.01 0.01\n";
    for (const double x : {-0.01, 0.01})
      for (const double y : {-0.01, 0.01})
        for (const double z : {-0.01, 0.01}) {
          const double b = 0.001 + more * x;  // at the centre always the same
          text += fmt::format("{} {} {} {} {} {}\n", x, y, z, axis == 0 ? b : 0, axis == 1 ? b : 0,
                              axis == 2 ? b : 0);
        }
    folder.with(fmt::format("coil{}.txt", axis), text);
  };
  for (int axis = 0; axis < 3; ++axis) grid(axis, 0);
  folder.with("coils.yaml", "coils: {type: vfield, files: [coil0.txt, coil1.txt, coil2.txt]}\n");
  const auto hash = [&] { return rig_hash(read_rig(folder / "rig.yaml")); };
  const std::string before = hash();
  EXPECT_EQ(hash(), before);
  grid(1, 0.01);
  EXPECT_NE(hash(), before);
}

TEST_F(QueueTest, AChangedRigIsToldWhenTheQueueGoesOn) {
  const std::string text = "entries: [{scenario: a.yaml}, {scenario: b.yaml}]\n";
  results["b"] = {faulty(FaultKind::device)};
  EXPECT_EQ(run(open(text)), QueueEnd::needs_person);
  const std::string before = state().rig_hash;
  EXPECT_EQ(before, rig_hash(read_rig(folder / "rig.yaml")));
  told.clear();
  folder.with("rig.yaml", "coils: coils.yaml\ndelay_s: 0.2\n");
  EXPECT_EQ(run(open(text)), QueueEnd::complete);
  EXPECT_TRUE(test::names(told.front(), "rig.yaml or its coils have changed")) << told.front();
  EXPECT_NE(state().rig_hash, before);
  EXPECT_EQ(ran, (Names{"001-a-1", "002-b-1", "002-b-1-attempt2"}));
}

TEST_F(QueueTest, AReasonIsToldOnce) {
  const auto count = [&](const std::string& part) {
    return std::ranges::count_if(told, [&](const auto& line) { return test::names(line, part); });
  };
  results["a"] = {{.end = AttemptEnd::refused, .reason = "the map is of another chip"}};
  results["b"] = {faulty(FaultKind::swarm, "the swarm was lost")};
  results["c"] = {faulty(FaultKind::device, "the device is gone")};
  EXPECT_EQ(run(open("entries: [{scenario: a.yaml}, {scenario: b.yaml}, {scenario: c.yaml}]\n")),
            QueueEnd::needs_person);
  for (const char* reason :
       {"the map is of another chip", "the swarm was lost", "the device is gone"})
    EXPECT_EQ(count(reason), 1) << reason;
  EXPECT_EQ(count("001-a-1: has failed; the queue goes on"), 1);
  EXPECT_EQ(count("the queue has stopped for a person"), 1);
  EXPECT_EQ(alarms.size(), 3u);
}

TEST_F(QueueTest, AChangedScenarioIsRunAnew) {
  const std::string text = "entries: [{scenario: a.yaml}, {scenario: b.yaml}]\n";
  EXPECT_EQ(run(open(text)), QueueEnd::complete);
  folder.with("b.yaml", scenario(1400));
  told.clear();
  EXPECT_EQ(run(open(text)), QueueEnd::complete);
  EXPECT_EQ(ran, (Names{"001-a-1", "002-b-1", "002-b-1-attempt2"}));
  EXPECT_TRUE(test::names(told.front(), "has changed")) << told.front();
  EXPECT_EQ(state().items.back().state, ItemState::dropped);
  // Another order, and an entry more: only that is run.
  ran.clear();
  EXPECT_EQ(run(open("entries: [{scenario: b.yaml}, {scenario: c.yaml}, {scenario: a.yaml}]\n")),
            QueueEnd::complete);
  EXPECT_EQ(ran, (Names{"002-c-1"}));
  // What was left out and is there again is still done.
  EXPECT_EQ(run(open("entries: [{scenario: b.yaml}]\n")), QueueEnd::complete);
  EXPECT_EQ(run(open("entries: [{scenario: a.yaml}, {scenario: b.yaml}]\n")), QueueEnd::complete);
  EXPECT_EQ(ran.size(), 1u);
}

TEST_F(QueueTest, ADamagedStateIsRefused) {
  write_file_atomically(queue_state_file(out()), "items: 3\n");
  EXPECT_TRUE(
      test::names(test::error_of([&] { run(open("entries: [{scenario: a.yaml}]\n")); }), "items"));
  EXPECT_TRUE(ran.empty());
}

TEST(CoolDown, OfTheSlowestCoil) {
  actuation::AmplifierParams coil;
  coil.ambient = 20;
  coil.thermal_time = 100;
  actuation::AmplifierParams slow = coil;
  slow.thermal_time = 1000;
  const std::vector<actuation::AmplifierParams> coils{coil, slow};
  const CoolDown wait = cool_down_from(coils, Eigen::Vector2d(80, 41), {40, 40});
  EXPECT_NEAR(wait.seconds, 100 * std::log(3), 1e-9);
  EXPECT_EQ(wait.coil, 0u);
  const Eigen::VectorXd then = actuation::cooled(coils, Eigen::Vector2d(80, 41), wait.seconds);
  EXPECT_NEAR(then[0], 40, 1e-9);
  EXPECT_EQ(cool_down_from(coils, Eigen::Vector2d(40, 30), {40, 40}).seconds, 0);
}

}  // namespace
}  // namespace microswarm::rig
