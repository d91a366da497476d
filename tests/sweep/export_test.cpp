// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/export.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/sweep/summary.hpp"
#include "tests/messages.hpp"
#include "tests/sweep/sweeps.hpp"

namespace microswarm::sweep {
namespace {

/// A Python that has the module, or nothing.
std::string python_with(const std::string& module) {
  for (const std::string candidate : {"/usr/bin/python3", "python3"})
    if (std::system((candidate + " -c 'import " + module + "' > /dev/null 2>&1").c_str()) == 0)
      return candidate;
  return {};
}

class SweepExport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() = sweep_folder("sweep_export", sweep_text(2));
    run_alone(load_sweep(folder() / "sweep.yaml", 1), folder() / "sweep.db", 2);
  }
  static std::filesystem::path& folder() {
    static std::filesystem::path path;
    return path;
  }
  static bool python(const std::string& module, const std::string& arguments) {
    const std::string command =
        python_with(module) + " " + MICROSWARM_SOURCE_DIR + "/tests/sweep/" + arguments;
    return std::system(command.c_str()) == 0;
  }
  SweepReader sweep{folder() / "sweep.db"};
};

TEST_F(SweepExport, CsvHasALineATrial) {
  const std::string csv = sweep_csv(sweep);
  EXPECT_TRUE(
      csv.starts_with("cell,trial,method,navigator_clearance_um,goal_um,status,arrived,time_s,"))
      << csv.substr(0, 200);
  EXPECT_NE(csv.find("\n0,0,straight on,60,\"[700, 500]\",solved,1,"), csv.npos);
  EXPECT_NE(csv.find("\n7,1,route,90.5,\"[800, 600]\",solved,1,"), csv.npos);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 17);
}

TEST_F(SweepExport, SummaryAgreesWithTheRows) {
  const std::vector<CellSummary> cells = summarise(sweep);
  ASSERT_EQ(cells.size(), 8u);
  for (const CellSummary& cell : cells) {
    std::vector<double> times;
    const std::size_t time = sweep.column("time_s"), arrived = sweep.column("arrived");
    sweep.each_row(
        [&](std::span<const SqlValue> row) {
          if (row[arrived] == SqlValue{std::int64_t{1}})
            times.push_back(std::get<double>(row[time]));
        },
        cell.cell);
    EXPECT_EQ(cell.trials, 2u);
    EXPECT_EQ(cell.arrived, times.size());
    ASSERT_FALSE(times.empty());
    EXPECT_EQ(cell.medians.at("time_s"), median(times));
    EXPECT_FALSE(cell.medians.contains("cell"));
  }
  EXPECT_EQ(cells[1].method, "route");
}

TEST_F(SweepExport, H5pyReadsIt) {
  if (python_with("h5py").empty()) GTEST_SKIP() << "python3-h5py is not installed";
  write_file_atomically(folder() / "sweep.h5", sweep_hdf5(sweep));
  write_file_atomically(folder() / "sweep.csv", sweep_csv(sweep));
  EXPECT_TRUE(python("h5py", "read_sweep.py " + (folder() / "sweep.h5").string() + " " +
                                 (folder() / "sweep.csv").string()));
}

TEST_F(SweepExport, PlannerArenasImporterReadsTheLogs) {
  if (python_with("sqlite3").empty()) GTEST_SKIP() << "python3 is not installed";
  const auto logs = ompl_logs(sweep);
  ASSERT_EQ(logs.size(), 4u);
  std::string files;
  for (const auto& [name, log] : logs) {
    write_file_atomically(folder() / name, log);
    files += " " + (folder() / name).string();
  }
  write_file_atomically(folder() / "sweep.csv", sweep_csv(sweep));
  EXPECT_TRUE(python("sqlite3", "read_ompl_logs.py " + (folder() / "sweep.csv").string() + files));
}

/// Writes logs into the folder; their names with a blank before each.
std::string write_logs(const SweepReader& sweep, const std::filesystem::path& folder) {
  std::string files;
  for (const auto& [name, log] : ompl_logs(sweep)) {
    write_file_atomically(folder / name, log);
    files += " " + (folder / name).string();
  }
  return files;
}

TEST_F(SweepExport, LogsKeepToOmplsGrammar) {
  if (python_with("re").empty()) GTEST_SKIP() << "python3 is not installed";
  EXPECT_TRUE(python("re", "ompl_grammar.py" + write_logs(sweep, folder())));

  // Keys that are columns of every experiment, words, truth values, a description, nothing to try.
  const auto odd = sweep_folder("sweep_odd", R"(name: "odd: | sweep"
scenario: flight.yaml
description: |
  of two lines,
  |>>> like a mark
set: [time_limit_s=1]
grid:
  - {key: name, values: [one, two]}
  - {key: stop_at_contact, values: [true, false]}
  - {key: navigator.guide, values: [straight, route]}
methods:
  - {name: a | b, set: ["goal_um=[700, 500]", "description=a = b"]}
  - {name: plain}
trials: 1
)");
  run_alone(load_sweep(odd / "sweep.yaml", 1), odd / "sweep.db", 2);
  const SweepReader odd_sweep(odd / "sweep.db");
  ASSERT_EQ(ompl_logs(odd_sweep).size(), 8u);
  EXPECT_TRUE(python("re", "ompl_grammar.py" + write_logs(odd_sweep, odd)));
}

TEST_F(SweepExport, TrialsThatAreMissingAreNotInTheLogs) {
  const auto file = folder() / "partial.db";
  std::filesystem::copy_file(folder() / "sweep.db", file,
                             std::filesystem::copy_options::overwrite_existing);
  Database(file, Database::Access::write).run("DELETE FROM trials WHERE cell < 3 OR trial = 1");
  const auto logs = ompl_logs(SweepReader(file));
  ASSERT_EQ(logs.size(), 3u);
  EXPECT_EQ(logs[0].first, "00001.log");
  EXPECT_NE(logs[0].second.find("\n1 planners\nroute\n"), std::string::npos);
  const auto partial = experiment::empty_folder("partial_logs");
  EXPECT_TRUE(python("re", "ompl_grammar.py" + write_logs(SweepReader(file), partial)));
}

#ifdef OMPL_LOG_WRITER
TEST_F(SweepExport, OmplsOwnLogHasTheSameGrammar) {
  if (python_with("re").empty()) GTEST_SKIP() << "python3 is not installed";
  // It leaves a file of its own where it runs.
  const std::string in_folder = "cd '" + folder().string() + "' && " OMPL_LOG_WRITER " ompl.log";
  ASSERT_EQ(std::system(in_folder.c_str()), 0);
  EXPECT_TRUE(python("re", "ompl_grammar.py --ompl " + (folder() / "ompl.log").string()));
}
#endif

TEST_F(SweepExport, WhatAKilledWriterLeftHalfDoneIsUndone) {
  const auto file = folder() / "killed.db";
  std::filesystem::copy_file(folder() / "sweep.db", file);
  const pid_t child = ::fork();
  if (child == 0) {
    Database database(file, Database::Access::write);
    database.run("PRAGMA cache_size = 2");  // pages go to the disk before the transaction ends
    database.transaction([&] {
      for (std::int64_t i = 0; i < 200; ++i)
        database.run("INSERT INTO cells(cell, scenario) VALUES(?, ?)",
                     std::vector<SqlValue>{100 + i, std::string(5000, 'x')});
      ::kill(::getpid(), SIGKILL);
    });
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(file.string() + "-journal"));
  EXPECT_EQ(SweepReader(file).cells(), 8u);
  EXPECT_EQ(physical_rows(file), physical_rows(folder() / "sweep.db"));
}

struct DatabaseFile : testing::Test {
  std::filesystem::path file = experiment::empty_folder("database") / "a.db";
  void SetUp() override { std::ofstream(file).close(); }
  std::string refused(const std::string& sql, Database::Access access = Database::Access::write) {
    const std::string what = experiment::error_of([&] { Database(file, access).run(sql); });
    EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 0) << what;
    return what.substr(std::min(what.size(), file.string().size() + 2));
  }
};

TEST_F(DatabaseFile, KeepsEveryKindOfValue) {
  Database database(file, Database::Access::write);
  database.run("CREATE TABLE t(a, b, c, d, e)");
  const std::vector<SqlValue> values{std::int64_t{-1} << 62, -0.1, std::string("a\0b", 3),
                                     std::string(), std::monostate{}};
  database.run("INSERT INTO t VALUES(?, ?, ?, ?, ?)", values);
  std::vector<SqlValue> back;
  database.select("SELECT * FROM t", {},
                  [&](std::span<const SqlValue> row) { back.assign(row.begin(), row.end()); });
  EXPECT_EQ(back, values);
  EXPECT_EQ(database.number("SELECT a FROM t WHERE b > 0"), 0);
}

TEST_F(DatabaseFile, ATransactionThatThrowsIsUndone) {
  Database database(file, Database::Access::write);
  database.run("CREATE TABLE t(a)");
  const auto fails = [&] {
    database.transaction([&] {
      database.run("INSERT INTO t VALUES(1)");
      database.run("INSERT INTO none VALUES(1)");
    });
  };
  EXPECT_EQ(experiment::error_of(fails), file.string() + ": no such table: none");
  EXPECT_EQ(database.number("SELECT count(*) FROM t"), 0);
  database.transaction([&] { database.run("INSERT INTO t VALUES(1)"); });
  EXPECT_EQ(database.number("SELECT count(*) FROM t"), 1);
}

TEST_F(DatabaseFile, ErrorsAreOneLine) {
  EXPECT_EQ(refused("CREATE TABLE"), "incomplete input");
  EXPECT_EQ(refused("SELECT 1\n FROM\n none"), "no such table: none");
  Database(file, Database::Access::write).run("CREATE TABLE t(a INTEGER PRIMARY KEY)");
  EXPECT_EQ(refused("INSERT INTO t VALUES('x')"), "datatype mismatch");
  std::filesystem::resize_file(file, 4096);
  std::ofstream(file, std::ios::app) << std::string(4096, 'x');
  EXPECT_EQ(refused("SELECT * FROM t"), "is damaged: database disk image is malformed");
  std::ofstream(file) << std::string(1000, 'x');
  EXPECT_EQ(refused("SELECT 1 FROM t"), "is no SQLite database");
  std::filesystem::remove(file);
  EXPECT_EQ(refused("SELECT 1", Database::Access::read), "cannot read: No such file or directory");
  EXPECT_EQ(refused("SELECT 1"), "cannot write: No such file or directory");
}

TEST_F(DatabaseFile, ViewsAndTriggersDoNothing) {
  {
    Database database(file, Database::Access::write);
    database.run("CREATE TABLE t(a)");
    database.run("CREATE TRIGGER more AFTER INSERT ON t BEGIN INSERT INTO t VALUES(7); END");
    database.run("INSERT INTO t VALUES(1)");
    EXPECT_EQ(database.number("SELECT count(*) FROM t"), 1);
    database.run("CREATE VIEW seen AS SELECT a FROM t");
    database.run(
        "CREATE VIEW endless AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) "
        "SELECT i FROM n");
  }
  EXPECT_TRUE(test::is_one_line_naming(refused("SELECT * FROM seen"), "", {"view", "seen"}));
  EXPECT_NE(refused("SELECT * FROM endless"), "nothing was thrown");
}

TEST_F(DatabaseFile, StatementsWithoutARowEnd) {
  EXPECT_TRUE(test::is_one_line_naming(
      refused("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) "
              "SELECT i FROM n WHERE i < 0"),
      "", {"end"}));
}

TEST_F(DatabaseFile, LongValuesAreRefused) {
  Database(file, Database::Access::write).run("CREATE TABLE t(a)");
  EXPECT_TRUE(test::is_one_line_naming(refused("INSERT INTO t VALUES(zeroblob(50000000))"), "",
                                       {"16777216"}));
}

TEST_F(SweepExport, AViewInPlaceOfTheTrialsIsRefused) {
  const auto file = folder() / "view.db";
  std::filesystem::copy_file(folder() / "sweep.db", file,
                             std::filesystem::copy_options::overwrite_existing);
  {
    Database database(file, Database::Access::write);
    database.run("ALTER TABLE trials RENAME TO others");
    database.run("CREATE VIEW trials AS SELECT * FROM others");
  }
  EXPECT_TRUE(test::is_one_line_naming(experiment::error_of([&] { SweepReader reader(file); }),
                                       file.string(), {"trials", "no table"}));
}

TEST(RecordExport, TablesAsCsv) {
  const experiment::Record record = experiment::record_of(experiment::small_flight());
  const std::string frames = record_csv(record, "frames");
  EXPECT_TRUE(frames.starts_with("t_s,x_um,y_um,heading_rad,")) << frames.substr(0, 100);
  EXPECT_EQ(static_cast<std::size_t>(std::count(frames.begin(), frames.end(), '\n')),
            record.frames.size() + 1);
  EXPECT_TRUE(record_csv(record, "paths/points").starts_with("row,x_um,y_um\n0,"));
  EXPECT_TRUE(record_csv(record, "events").starts_with("t_s,kind,"));
  EXPECT_TRUE(experiment::error_of([&] {
                record_csv(record, "frame");
              }).starts_with("the record has no table 'frame', only frames, paths, "));
}

TEST(RecordExport, DiagnosticsAsCsv) {
  experiment::Record record = experiment::record_of(experiment::small_flight());
  const auto refusal = [&] {
    return experiment::error_of([&] { record_csv(record, "diagnostics/beams"); });
  };
  record.diagnostics = {};
  EXPECT_TRUE(test::is_one_line_naming(
      refusal(), "", {"'diagnostics/beams'", "frames", "record.diagnostics=true"}))
      << refusal();
  EXPECT_EQ(refusal().find("diagnostics/radar"), std::string::npos);
  record.diagnostics.add(0.5, RadarDiagnostics{.radius = 7, .beams = {{.heading = 1}, {}}});
  record.diagnostics.add(
      1, RadarDiagnostics{.best = 0, .beams = {{.fate = BeamFate::wall, .score = 0.25}}});
  EXPECT_TRUE(test::is_one_line_naming(
      refusal(), "",
      {"'diagnostics/beams'", "frames", "diagnostics/radar,", "diagnostics/radar/beams"}))
      << refusal();
  const std::string radar = record_csv(record, "diagnostics/radar");
  EXPECT_TRUE(radar.starts_with("t_s,centre_x_um,centre_y_um,radius_um,")) << radar;
  EXPECT_NE(radar.find("\n0.5,0,0,7,"), std::string::npos) << radar;
  EXPECT_EQ(std::count(radar.begin(), radar.end(), '\n'), 3);
  EXPECT_EQ(record_csv(record, "diagnostics/radar/beams"),
            "row,heading_rad,fate,obstacle,score\n0,1,kept,,0\n0,0,kept,,0\n1,0,wall,,0.25\n");
}

}  // namespace
}  // namespace microswarm::sweep
