// SPDX-License-Identifier: Apache-2.0
#include "tests/messages.hpp"
#include "tests/sweep/sweeps.hpp"

#include <fmt/format.h>

#include <bit>
#include <limits>

#include "microswarm/experiment/trials.hpp"
#include "microswarm/sweep/worker_pool.hpp"

namespace microswarm::sweep {
namespace {

std::string complaint(const std::string& text) {
  return experiment::error_of([&] { read_sweep_text(text, "s.yaml"); });
}

TEST(SweepFile, SaysWhatIsWrongInOneLine) {
  const std::string head = "scenario: a.yaml\n";
  EXPECT_EQ(complaint(head + "trials: 0\n"), "s.yaml:2:9: trials is 0, allowed 1..1e6");
  EXPECT_TRUE(test::is_one_line_naming(complaint(head), "s.yaml:1:1", {"missing", "trials"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(head + "trials: 1\ngird: []\n"), "s.yaml:3:1",
                                       {"gird", "grid"}));
  const std::string grid = head + "trials: 1\ngrid:\n";
  EXPECT_TRUE(test::is_one_line_naming(complaint(grid + "  - {key: tick_s, values: []}\n"),
                                       "s.yaml", {"tick_s", "empty"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(grid + "  - {key: tick_s, values: [1, 2, 1]}\n"),
                                       "s.yaml", {"tick_s", "1"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint(grid + "  - {key: seed, values: [1]}\n"), "s.yaml",
                                       {"grid", "seed"}));
  const std::string axis = "  - {key: tick_s, values: [1]}\n";
  EXPECT_TRUE(
      test::is_one_line_naming(complaint(grid + axis + axis), "s.yaml", {"tick_s", "twice"}));
  const std::string methods = head + "trials: 1\nmethods:\n";
  EXPECT_TRUE(test::is_one_line_naming(complaint(methods + "  - {name: a}\n  - {name: a}\n"),
                                       "s.yaml", {"methods", "a"}));
  EXPECT_EQ(complaint(methods + "  - {name: \"\"}\n"),
            "s.yaml: a method's name is '', must be one line of text");
  EXPECT_TRUE(test::is_one_line_naming(complaint(methods + "  - {name: a, set: [seed=3]}\n"),
                                       "s.yaml", {"seed=3", "set", "seed"}));
}

TEST(SweepFile, TooManyTrialsAreRefused) {
  std::string grid;
  for (const char* key : {"a", "b", "c"}) {
    grid += std::string("  - key: ") + key + "\n    values: [";
    for (int i = 0; i < 60; ++i) grid += std::to_string(i) + ",";
    grid += "]\n";
  }
  EXPECT_TRUE(test::is_one_line_naming(complaint("scenario: a.yaml\ntrials: 1\ngrid:\n" + grid),
                                       "s.yaml", {"100000", "cells"}));
  EXPECT_TRUE(test::is_one_line_naming(
      complaint("scenario: a.yaml\ntrials: 1000000\ngrid:\n" + grid.substr(0, grid.size() / 3)),
      "s.yaml", {"10000000", "trials"}));
}

TEST(SweepPlan, CellsAreTheCrossProduct) {
  const auto folder = sweep_folder("sweep_cells", sweep_text());
  const SweepPlan plan = load_sweep(folder / "sweep.yaml", 2);
  ASSERT_EQ(plan.cells.size(), 8u);
  EXPECT_EQ(plan.cells[0].values, (std::vector<std::string>{"60", "[700, 500]"}));
  EXPECT_EQ(plan.cells[0].method, "straight on");
  EXPECT_EQ(plan.cells[1].method, "route");
  EXPECT_EQ(plan.cells[2].values, (std::vector<std::string>{"60", "[800, 600]"}));
  EXPECT_EQ(plan.cells[7].values, (std::vector<std::string>{"90.5", "[800, 600]"}));
  EXPECT_EQ(navigation::required_clearance(plan.cells[7].scenario.navigator), 90.5);
  EXPECT_EQ(plan.cells[7].scenario.time_limit, 20);
  EXPECT_EQ(plan.cells[7].scenario.seed, 7u);
  EXPECT_EQ(plan.cells[0].world.map, plan.cells[7].world.map);
  EXPECT_EQ(plan.hash(), load_sweep(folder / "sweep.yaml", 1).hash());
}

TEST(SweepPlan, TheSweepThatComesWithTheProgramCanBeRun) {
  const std::filesystem::path folder = std::string(MICROSWARM_SOURCE_DIR) + "/scenarios/sweeps";
  const SweepPlan plan = load_sweep(folder / "first_flight.yaml", 2);
  check(plan, 2);
  EXPECT_EQ(plan.cells.size(), 12u);
}

TEST(SweepFile, TheOneInTheDocsIsRead) {
  const std::string page = read_file(std::string(MICROSWARM_SOURCE_DIR) + "/docs/how-to/sweep.md");
  const std::size_t begin = page.find("```yaml\n") + 8;
  const Sweep sweep = read_sweep_text(page.substr(begin, page.find("```", begin) - begin), "docs");
  EXPECT_EQ(sweep.methods.at(1).set.at(0), "navigator.horizon_s=0");
}

TEST(SweepPlan, BadSettingsNameWhereTheyStand) {
  const auto refused = [](const std::string& from, const std::string& to) {
    std::string text = sweep_text();
    text.replace(text.find(from), from.size(), to);
    const auto folder = sweep_folder("sweep_bad", text);
    const std::string file = (folder / "sweep.yaml").string();
    const std::string what = experiment::error_of([&] { check(load_sweep(file, 2), 2); });
    return what.starts_with(file + ": ") ? what.substr(file.size() + 2) : "elsewhere: " + what;
  };
  EXPECT_EQ(refused("navigator.clearance_um", "navigator.magrin_um"),
            "grid: navigator.magrin_um: unknown key 'magrin_um', did you mean 'clearance_um'?");
  EXPECT_EQ(refused("guide=straight", "guide=sideways"),
            "method 'straight on': navigator.guide: guide is 'sideways', allowed: straight, "
            "route");
  EXPECT_EQ(refused("time_limit_s=20", "time_limit_s=-1"),
            "set: time_limit_s: time_limit_s is -1 s, allowed 0..1e5 s");
  EXPECT_TRUE(
      refused("[800, 600]", "[1000, 100]")
          .starts_with("navigator.clearance_um=60, goal_um=[1000, 100], method 'straight on': "
                       "goal "));
}

TEST(SweepPlan, FormerKeysAreNotedOnceAndAreNoSecondParameter) {
  std::string text = sweep_text();
  const std::string key = "key: navigator.clearance_um";
  text.replace(text.find(key), key.size(), "key: navigator.margin_um");
  const auto folder = sweep_folder("sweep_former", text);
  const std::string file = (folder / "sweep.yaml").string();
  const SweepPlan plan = load_sweep(folder / "sweep.yaml", 2);
  EXPECT_EQ(plan.notes,
            Notes{file + ": grid: navigator.margin_um: is now 'navigator.clearance_um'"});
  EXPECT_EQ(navigation::required_clearance(plan.cells[7].scenario.navigator), 90.5);

  const std::string goal = "key: goal_um, values: [\"[700, 500]\", \"[800, 600]\"]";
  text.replace(text.find(goal), goal.size(), "key: navigator.clearance_um, values: [50]");
  const auto both = sweep_folder("sweep_both", text);
  EXPECT_EQ(experiment::error_of([&] { load_sweep(both / "sweep.yaml", 2); }),
            (both / "sweep.yaml").string() +
                ": 'navigator.clearance_um' is varied by the grid and set a second time, in the "
                "grid, in 'set' or by method 'straight on'");
}

TEST(SweepPlan, AKeyOfTheGridIsNotSetElsewhere) {
  const auto refused = [](const std::string& from, const std::string& to) {
    std::string text = sweep_text();
    text.replace(text.find(from), from.size(), to);
    const auto folder = sweep_folder("sweep_twice", text);
    return experiment::error_of([&] { load_sweep(folder / "sweep.yaml", 2); });
  };
  EXPECT_NE(refused("navigator.guide=straight", "navigator.clearance_um=77")
                .find("'navigator.clearance_um' is varied by the grid"),
            std::string::npos);
}

TEST(SweepPlan, AsPublishedBesideAKeyOfOursIsRefused) {
  const auto refused = [](const std::string& set) {
    std::string text = sweep_text();
    const std::string from = "navigator.guide=straight";
    text.replace(text.find(from), from.size(), set);
    const auto folder = sweep_folder("sweep_published", text);
    return experiment::error_of([&] { check(load_sweep(folder / "sweep.yaml", 2), 2); });
  };
  const std::string published = "\"navigator={type: hierarchical_drrt_star, as_published: true";
  EXPECT_EQ(refused(published + "}\""), "");
  const std::string complaint =
      "method 'straight on': extra_clearance_um is not the paper's, and as_published is true";
  EXPECT_TRUE(refused(published + ", extra_clearance_um: 10}\"").ends_with(complaint));
  EXPECT_NE(refused("navigator.as_published=true").find(complaint),
            std::string::npos);  // it is in the file
}

TEST(SweepPlan, ATrialIsTheTrialOfRun) {
  const auto folder = sweep_folder("sweep_trial", sweep_text());
  const SweepPlan plan = load_sweep(folder / "sweep.yaml", 1);
  const auto trials =
      experiment::run_trials(plan.cells[3].scenario, plan.cells[3].world, {.trials = 3});
  for (std::uint32_t trial = 0; trial < 3; ++trial)
    EXPECT_EQ(run_task(plan, {3, trial}).hash, trials[trial].hash);
}

TEST(SweepTable, EveryMetricHasItsColumnWithUnit) {
  const auto folder = sweep_folder("sweep_columns", sweep_text());
  const SweepPlan plan = load_sweep(folder / "sweep.yaml", 1);
  const std::vector<SweepColumn> columns = sweep_columns(plan);
  const auto named = [&](const std::string& name) {
    for (const SweepColumn& column : columns)
      if (column.name == name) return column;
    ADD_FAILURE() << name;
    return SweepColumn{};
  };
  EXPECT_EQ(named("turning_rad").unit, "rad");
  EXPECT_EQ(named("walls_clearance_um").role, SweepColumn::Role::metric);
  EXPECT_EQ(named("contacts").kind, SweepColumnKind::whole);
  EXPECT_EQ(named("navigator_clearance_um").kind, SweepColumnKind::real);
  EXPECT_EQ(named("goal_um").kind, SweepColumnKind::text);
  EXPECT_EQ(named("planning_max_s").role, SweepColumn::Role::wall_clock);
}

SweepMessage some_message() {
  return {.kind = SweepMessage::Kind::rows,
          .text = std::string("a\0\xff\n", 4),
          .want = 3,
          .tasks = {{1, 4'294'967'295}},
          .rows = {{{4, 5}, {std::int64_t{-1}, 0.1, std::string("x"), {}}}}};
}

TEST(SweepMessage, ComesBackAsItWas) {
  const SweepMessage message = some_message();
  const SweepMessage back = parse_message(to_bytes(message));
  EXPECT_EQ(back.kind, message.kind);
  EXPECT_EQ(back.text, message.text);
  EXPECT_EQ(back.want, 3u);
  EXPECT_EQ(back.tasks.at(0).trial, 4'294'967'295u);
  EXPECT_EQ(back.rows.at(0).task.cell, 4u);
  EXPECT_EQ(back.rows.at(0).values, message.rows[0].values);
}

TEST(SweepMessage, NumbersKeepEveryBit) {
  using Limits = std::numeric_limits<double>;
  SweepMessage message;
  message.rows.push_back({{}, {}});
  for (const double real : {0.0, -0.0, 1.0, -2.5, 0.1, Limits::infinity(), -Limits::infinity(),
                            Limits::quiet_NaN(), -Limits::quiet_NaN(), Limits::denorm_min(),
                            Limits::max(), std::bit_cast<double>(0x7ff8'0000'dead'beefULL)})
    message.rows[0].values.emplace_back(real);
  for (const std::int64_t whole : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1},
                                   std::int64_t{0}, std::numeric_limits<std::int64_t>::max()})
    message.rows[0].values.emplace_back(whole);
  const std::vector<SqlValue> back = parse_message(to_bytes(message)).rows.at(0).values;
  ASSERT_EQ(back.size(), message.rows[0].values.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    ASSERT_EQ(back[i].index(), message.rows[0].values[i].index());
    if (const auto* real = std::get_if<double>(&back[i]))
      EXPECT_EQ(std::bit_cast<std::uint64_t>(*real),
                std::bit_cast<std::uint64_t>(std::get<double>(message.rows[0].values[i])));
    else
      EXPECT_EQ(back[i], message.rows[0].values[i]);
  }
}

TEST(SweepMessage, MalformedBytesAreRefused) {
  const std::string bytes = to_bytes(some_message());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(experiment::error_of([&] { parse_message(bytes.substr(0, size)); }),
              fmt::format("mpirun: malformed message of {} bytes", size));
  EXPECT_NE(experiment::error_of([&] { parse_message(bytes + '\0'); }), "");
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (int value = 0; value < 256; ++value) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(value);
      experiment::error_of([&] { parse_message(changed); });  // an InputError or a message
    }
  std::string unknown = to_bytes({});
  unknown[1] = 7;
  EXPECT_EQ(experiment::error_of([&] { parse_message(unknown); }),
            fmt::format("mpirun: malformed message of {} bytes", unknown.size()));
}

}  // namespace
}  // namespace microswarm::sweep
