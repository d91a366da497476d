// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/sweep.hpp"

#include <atomic>
#include <fstream>

#include "tests/sweep/sweeps.hpp"

namespace microswarm::sweep {
namespace {

TEST(Sweep, RowsAreTheSameForAnyNumberOfThreads) {
  const auto folder = sweep_folder("sweep_threads", sweep_text());
  const SweepPlan plan = load_sweep(folder / "sweep.yaml", 1);
  std::vector<std::vector<std::vector<SqlValue>>> tables;
  for (const int jobs : {1, 2, 4}) {
    const auto file = folder / (std::to_string(jobs) + ".db");
    const SweepProgress progress = run_alone(plan, file, jobs);
    EXPECT_EQ(progress.added, 24u);
    EXPECT_EQ(progress.left, 0u);
    tables.push_back(physical_rows(file));
  }
  EXPECT_EQ(tables[0].size(), 24u);
  EXPECT_EQ(tables[0], tables[1]);
  EXPECT_EQ(tables[0], tables[2]);
}

TEST(Sweep, GoesOnWhereItWasStopped) {
  const auto folder = sweep_folder("sweep_stop", sweep_text(4));
  const SweepPlan plan = load_sweep(folder / "sweep.yaml", 1);
  run_alone(plan, folder / "whole.db", 2);
  std::size_t there = 0;
  int runs = 0;
  for (; there < 32 && runs < 100; ++runs) {
    std::atomic<bool> flag{false};
    const Ranks ranks;
    RemoteWorkers workers(ranks);
    SweepDatabase database(folder / "parts.db", plan, {});
    SweepOptions options{.jobs = 2,
                         .progress = [&](const SweepProgress& p) { flag = p.added > 2; }};
    const SweepProgress progress = run_sweep(plan, database, workers, options, Stop(&flag));
    EXPECT_EQ(progress.before, there);
    there = progress.before + progress.added;
    EXPECT_EQ(progress.left, 32 - there);
  }
  EXPECT_GT(runs, 1);
  EXPECT_EQ(physical_rows(folder / "parts.db"), physical_rows(folder / "whole.db"));
  EXPECT_EQ(run_alone(plan, folder / "parts.db", 1).added, 0u);
}

TEST(Sweep, OneWriterAtATime) {
  const auto folder = sweep_folder("sweep_lock", sweep_text(1));
  const SweepPlan plan = load_sweep(folder / "sweep.yaml", 1);
  const std::string file = (folder / "one.db").string();
  {
    const SweepDatabase first(file, plan, {});
    EXPECT_EQ(experiment::error_of([&] { SweepDatabase(file, plan, {}); }),
              file + ": another process is writing to it");
    EXPECT_EQ(SweepReader(file).trials(), 0u);
  }
  EXPECT_EQ(run_alone(plan, file, 1).added, 8u);
}

TEST(Sweep, OnAChangedInputIsRefused) {
  const auto folder = sweep_folder("sweep_changed", sweep_text(1));
  const std::string file = (folder / "one.db").string();
  run_alone(load_sweep(folder / "sweep.yaml", 1), file, 1);
  const auto refused = [&] {
    return experiment::error_of([&] { run_alone(load_sweep(folder / "sweep.yaml", 1), file, 1); });
  };
  const auto line = [&](const std::string& what) {
    return file + ": was begun with another " + what +
           ": go on with that one, or give another database";
  };
  write_file_atomically(folder / "sweep.yaml", sweep_text(2));
  EXPECT_EQ(refused(), line("sweep file"));
  write_file_atomically(folder / "sweep.yaml", "# the same\n" + sweep_text(1));
  EXPECT_EQ(refused(), "");
  experiment::Scenario scenario = experiment::small_flight();
  std::get<RibbonParams>(scenario.swarm).max_speed += 1;
  write_file_atomically(folder / "flight.yaml", experiment::scenario_text(scenario));
  EXPECT_EQ(refused(), line("scenario"));
}

TEST(Sweep, OnAChangedMapIsRefused) {
  experiment::Scenario scenario = experiment::small_flight();
  scenario.map =
      formats::RectanglesMap{.lo = Vec2{0, 0}, .hi = Vec2{2000, 1000}, .file = "walls.csv"};
  const auto folder = sweep_folder("sweep_map", sweep_text(1));
  write_file_atomically(folder / "flight.yaml", experiment::scenario_text(scenario));
  write_file_atomically(folder / "walls.csv", "950,0,100,450\n");
  const std::string file = (folder / "one.db").string();
  run_alone(load_sweep(folder / "sweep.yaml", 1), file, 1);
  write_file_atomically(folder / "walls.csv", "950,0,100,440\n");
  EXPECT_EQ(experiment::error_of([&] { run_alone(load_sweep(folder / "sweep.yaml", 1), file, 1); }),
            file +
                ": was begun with another map, track or program: go on with that one, or give "
                "another database");
}

TEST(Sweep, WhatIsNoDatabaseOfASweepIsRefused) {
  const auto folder = sweep_folder("sweep_foreign", sweep_text(1));
  const SweepPlan plan = load_sweep(folder / "sweep.yaml", 1);
  const auto refused = [&](const std::filesystem::path& file) {
    const std::string what = experiment::error_of([&] { SweepDatabase(file, plan, {}); });
    EXPECT_TRUE(what.starts_with(file.string() + ": ")) << what;
    return what.substr(std::min(what.size(), file.string().size() + 2));
  };
  EXPECT_EQ(refused(folder / "sweep.yaml"), "is no SQLite database");
  EXPECT_EQ(refused(folder), "is a folder, must be a file for the database");
  EXPECT_EQ(refused(folder / "none" / "x.db"), "cannot write: No such file or directory");

  const auto database = [&](const std::string& name) {
    const auto file = folder / name;
    std::ofstream(file).close();  // an empty file is a database without tables
    return file;
  };
  const auto foreign = database("foreign.db");
  Database(foreign, Database::Access::write).run("CREATE TABLE a(b)");
  EXPECT_EQ(refused(foreign), "is no database of a sweep");
  const auto newer = database("newer.db");
  { const SweepDatabase made(newer, plan, {}); }
  Database(newer, Database::Access::write).run("PRAGMA user_version = 2");
  EXPECT_EQ(refused(newer), "has sweep layout 2, this program knows layout 1");
  const auto older = database("older.db");
  { const SweepDatabase made(older, plan, {}); }
  Database(older, Database::Access::write)
      .run("UPDATE sweep SET value = '0.0.1' WHERE key = 'version'");
  EXPECT_EQ(refused(older),
            "was begun with another version of this program: go on with that one, or give another "
            "database");
  Database(older, Database::Access::write).run("DROP TABLE columns");
  EXPECT_NE(experiment::error_of([&] { SweepReader reader(older); }), "");
}

TEST(Sweep, ATableInMemoryHasTheRowsOfTheDatabase) {
  const auto folder = sweep_folder("table", sweep_text(2));
  const SweepPlan plan = load_sweep(folder / "sweep.yaml");
  run_alone(plan, folder / "rows.db", 1);
  SweepTable table(plan);
  EXPECT_EQ(table.missing().size(), 16u);
  const Ranks alone = Ranks::alone();
  RemoteWorkers none(alone);
  run_sweep(plan, table, none, {.jobs = 2, .progress = {}});
  EXPECT_TRUE(table.missing().empty());
  std::vector<std::vector<SqlValue>> rows;
  for (const auto row : table.rows()) {
    rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i)
      if (table.columns()[i].role != SweepColumn::Role::wall_clock) rows.back().push_back(row[i]);
  }
  EXPECT_EQ(rows, physical_rows(folder / "rows.db"));
}

TEST(Sweep, AStoppedPlanHasNoCells) {
  const auto folder = sweep_folder("stopped_plan", sweep_text());
  const std::atomic<bool> flag = true;
  EXPECT_TRUE(load_sweep(folder / "sweep.yaml", 1, Stop(&flag)).cells.empty());
}

}  // namespace
}  // namespace microswarm::sweep
