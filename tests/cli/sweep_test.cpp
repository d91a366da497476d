// SPDX-License-Identifier: Apache-2.0
// Sweeps as people run them: stopped, killed, twice at once, under mpirun, and what export makes of
// them.
#include <nlohmann/json.hpp>
#include <sstream>

#include "inputs.hpp"
#include "program.hpp"
#include "tests/cases.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

std::string sweep_of(int trials) {
  return "name: rooms\n"
         "scenario: flight.yaml\n"
         "grid:\n"
         "  - {key: navigator.clearance_um, values: [60, 80]}\n"
         "methods:\n"
         "  - {name: route, set: [navigator.guide=route]}\n"
         "  - {name: straight, set: [navigator.guide=straight]}\n"
         "trials: " +
         std::to_string(trials) + "\n";
}

/// A line of CSV without quotes in it.
std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> list;
  std::istringstream text(line);
  for (std::string word; std::getline(text, word, ',');) list.push_back(word);
  return list;
}

bool is_wall_clock(const std::string& column) {
  return column.starts_with("planning_m") || column.starts_with("step_") || column == "compute_s";
}

class Sweeps : public CommandLine {
 protected:
  Sweeps() {
    write("flight.yaml", noisy_rooms());
    write("sweep.yaml", sweep_of(6));
  }

  /// The table of a database but for wall-clock times.
  std::vector<std::vector<std::string>> table(const std::string& database) const {
    good({"export", database, "--csv", "table.csv"});
    std::istringstream csv(read("table.csv"));
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> head;
    for (std::string line; std::getline(csv, line);) {
      const std::vector<std::string> row = words(line);
      if (head.empty()) head = row;
      rows.emplace_back();
      for (std::size_t i = 0; i < row.size(); ++i)
        if (!is_wall_clock(head[i])) rows.back().push_back(row[i]);
    }
    return rows;
  }
};

TEST_F(Sweeps, TellsWhatCameOfEachCell) {
  const std::string text = good({"sweep", "sweep.yaml"});
  EXPECT_TRUE(text.starts_with("navigator_clearance_um  method    trials  arrived_%  ")) << text;
  EXPECT_NE(text.find("\n24 of 24 trials are in sweep.db, 24 of them new\n"), text.npos) << text;
  const Json again = Json::parse(good({"sweep", "sweep.yaml", "--json", "--csv", "trials.csv"}));
  EXPECT_EQ(again.at("added"), 0);
  EXPECT_EQ(again.at("cells").size(), 4u);
  EXPECT_EQ(again.at("cells")[3].at("parameters").at("navigator_clearance_um"), 80);
  EXPECT_EQ(again.at("cells")[3].at("method"), "straight");
  EXPECT_EQ(again.at("cells")[3].at("status").at("solved"), 6);
  EXPECT_EQ(files(),
            (std::set<std::string>{"flight.yaml", "sweep.yaml", "sweep.db", "trials.csv"}));
}

TEST_F(Sweeps, TrialsThatAreOneRunAreNoted) {
  write("flight.yaml", two_rooms());
  const auto note_on = [&](const std::string& text) {
    write("same.yaml", "name: same\nscenario: flight.yaml\n" + text);
    const Outcome outcome = run({"sweep", "same.yaml", "--json", "--out", "same.db"});
    fs::remove(at.folder / "same.db");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Json notes = Json::parse(outcome.out).at("notes");
    if (notes.empty()) return outcome.err;
    EXPECT_EQ(outcome.err, "note: " + notes[0].get<std::string>() + "\n");
    return notes[0].get<std::string>();
  };
  const std::string methods =
      "methods:\n  - {name: random trees, set: [navigator.guide=straight]}\n"
      "  - {name: radar, set: [navigator.type=radar]}\n";
  EXPECT_EQ(note_on("trials: 3\nset: [navigator.guide=straight]\n"), "");
  EXPECT_TRUE(is_one_line_naming(note_on("trials: 3\nset: [navigator.type=radar]\n"), "",
                                 {"all 3 trials", "same run"}));
  EXPECT_TRUE(is_one_line_naming(note_on(methods + "trials: 2\n"), "", {"1 of 2", "same run"}));
  EXPECT_EQ(note_on(methods + "trials: 1\n"), "");
}

TEST_F(Sweeps, ATrialIsThatOfRun) {
  good({"sweep", "sweep.yaml", "--jobs", "2"});
  const Json run =
      Json::parse(good({"run", "flight.yaml", "--trials", "6", "--json", "--set",
                        "navigator.clearance_um=80", "--set", "navigator.guide=route"}));
  const auto rows = table("sweep.db");
  for (std::size_t trial = 0; trial < 6; ++trial)
    EXPECT_EQ(rows[1 + 12 + trial].back(),
              run.at("trials")[trial].at("record_hash").get<std::string>());
}

TEST_F(Sweeps, StoppedAndKilledItGoesOn) {
  write("sweep.yaml", sweep_of(test::cases(40)));
  good({"sweep", "sweep.yaml", "--out", "whole.db"});
  {
    Program program({"sweep", "sweep.yaml", "--out", "parts.db", "--jobs", "1"}, at);
    for (int i = 0; i < 3000 && !exists("parts.db"); ++i) sleep_ms(10);
    sleep_ms(50);
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    if (outcome.code != 0) {  // it may have been done by then
      EXPECT_EQ(outcome.code, 3) << outcome.err;
      EXPECT_NE(outcome.out.find("; the same command resumes it\n"), std::string::npos)
          << outcome.out;
      EXPECT_EQ(outcome.err, "");
    }
  }
  int runs = 0;
  for (Outcome outcome; outcome.code != 0 && runs < 100; ++runs) {
    Program program({"sweep", "sweep.yaml", "--out", "parts.db", "--jobs", "2"}, at);
    program.let_work(runs < 5 ? 0 : 20 * runs);
    for (int i = 0; i < 5 && program.running(); ++i) sleep_ms(30);
    program.send(SIGKILL);
    outcome = program.wait();
    EXPECT_EQ(outcome.err, "");
  }
  EXPECT_LT(runs, 100);
  EXPECT_EQ(table("parts.db"), table("whole.db"));
  EXPECT_EQ(files(), (std::set<std::string>{"flight.yaml", "sweep.yaml", "whole.db", "parts.db",
                                            "table.csv"}));
}

TEST_F(Sweeps, TwoAtOnce) {
  write("long.yaml", with(sweep_of(4000), "scenario", "scenario: flight.yaml"));
  Program first({"sweep", "long.yaml", "--jobs", "1"}, at);
  for (int i = 0; i < 3000; ++i, sleep_ms(10)) {
    if (!exists("long.db")) continue;
    sleep_ms(100);  // until it holds what it has made
    const Outcome outcome = run({"sweep", "long.yaml"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "microswarm: long.db: another process is writing to it\n");
    break;
  }
  EXPECT_TRUE(first.running());
  first.send(SIGINT);
  EXPECT_EQ(first.wait().code, 3);
}

TEST_F(Sweeps, BadInputIsOneLine) {
  write("none.yaml", with(sweep_of(1), "trials", "trials: 0"));
  refused({"sweep", "none.yaml"}, naming("none.yaml:8:9", {"0", "1..1e6"}));
  write("key.yaml", with(sweep_of(1), "key:", "  - {key: navigator.magrin_um, values: [60]}"));
  refused({"sweep", "key.yaml"},
          naming("key.yaml", {"navigator.magrin_um", "magrin_um", "clearance_um"}));
  write("wide.yaml", with(sweep_of(1), "key:", "  - {key: swarm.radius_um, values: [40, 170]}"));
  const Outcome wide = run({"sweep", "wide.yaml"});
  EXPECT_EQ(wide.code, 2);
  EXPECT_TRUE(wide.err.starts_with("microswarm: wide.yaml: swarm.radius_um=170, method 'route': "))
      << wide.err;
  write("lost.yaml", with(sweep_of(1), "scenario", "scenario: lost/flight.yaml"));
  refused({"sweep", "lost.yaml"}, "lost/flight.yaml: cannot read: No such file or directory");
  refused({"sweep", "sweep.yaml", "--out", "flight.yaml"},
          naming("flight.yaml", {"SQLite", "database"}));
  refused({"sweep", "sweep.yaml", "--out", "."}, naming(".", {"folder", "database"}));
  refused({"export", "flight.yaml", "--csv", "x.csv"},
          naming("flight.yaml", {"SQLite", "database"}));
  refused({"export", "lost.db", "--csv", "x.csv"},
          "lost.db: cannot read: No such file or directory");
  refused({"export", "flight.yaml"}, naming("export", {"--csv", "--hdf5", "--ompl"}));
  write("empty.db", "");
  refused({"export", "empty.db", "--csv", "x.csv"}, naming("empty.db", {"database", "sweep"}));
}

TEST_F(Sweeps, AFullDiskIsOneLineAndNothingIsLost) {
  write("sweep.yaml", sweep_of(200));
  at.largest_file = 20'000;
  const Outcome outcome = run({"sweep", "sweep.yaml"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.err.starts_with("microswarm: sweep.db: cannot write: ")) << outcome.err;
  at.largest_file = 0;
  good({"sweep", "sweep.yaml"});
  EXPECT_EQ(table("sweep.db").size(), 801u);
}

TEST_F(Sweeps, ExportsARecordToo) {
  good({"run", "flight.yaml", "--out", "out", "--no-report"});
  EXPECT_EQ(good({"export", "out/run.h5", "--csv", "frames.csv"}), "wrote frames.csv\n");
  EXPECT_TRUE(read("frames.csv").starts_with("t_s,x_um,"));
  good({"export", "out/run.h5", "--csv", "events.csv", "--table", "events"});
  EXPECT_TRUE(read("events.csv").starts_with("t_s,kind,"));
  refused({"export", "out/run.h5", "--csv", "x.csv", "--table", "diagnostics/beams"},
          naming("", {"'diagnostics/beams'", "frames", "paths/points", "record.diagnostics"}));
  refused({"export", "out/run.h5", "--csv", "out/../out/run.h5"},
          "out/../out/run.h5: is the input, which would be lost");
  refused({"export", "out/run.h5", "--hdf5", "x.h5"}, naming("out/run.h5", {"HDF5"}));
  refused({"export", "out/run.h5", "--ompl", "x"}, naming("out/run.h5", {"--ompl", "database"}));
}

/// mpirun with the program, started here.
Outcome mpirun(const Surroundings& at, int ranks, const std::string& arguments) {
  const std::string command = "cd '" + at.folder.string() +
                              "' && ASAN_OPTIONS=detect_leaks=0 mpirun --allow-run-as-root " +
                              "--oversubscribe -n " + std::to_string(ranks) + " '" +
                              MICROSWARM_PROGRAM + "' " + arguments + " > mpi.out 2> mpi.err";
  Outcome outcome;
  outcome.code = WEXITSTATUS(std::system(command.c_str()));
  for (auto [name, text] : {std::pair{"mpi.out", &outcome.out}, {"mpi.err", &outcome.err}}) {
    *text = read_file(at.folder / name);
    fs::remove(at.folder / name);
  }
  return outcome;
}

TEST_F(Sweeps, RanksGiveTheRowsOfOne) {
  if (std::system("command -v mpirun > /dev/null") != 0) GTEST_SKIP() << "mpirun is not installed";
#ifdef MICROSWARM_HAS_MPI
  good({"sweep", "sweep.yaml", "--out", "0.db"});
  const auto rows = table("0.db");
  EXPECT_EQ(rows.size(), 25u);
  for (const int ranks : test::sanitized ? std::vector<int>{2} : std::vector<int>{1, 2, 4}) {
    const std::string file = std::to_string(ranks) + ".db";
    const Outcome outcome = mpirun(at, ranks, "sweep sweep.yaml --out " + file);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("24 of 24 trials are in " + file), std::string::npos) << outcome.out;
    EXPECT_EQ(table(file), rows) << ranks;
  }
  write("sweep.yaml", sweep_of(7));
  const Outcome outcome = mpirun(at, 3, "sweep sweep.yaml --out 2.db");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("microswarm: 2.db: was begun with another sweep file"),
            std::string::npos)
      << outcome.err;
#else
  const Outcome outcome = mpirun(at, 2, "sweep sweep.yaml");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("built without MPI"), std::string::npos) << outcome.err;
#endif
}

}  // namespace
}  // namespace microswarm::test
