// SPDX-License-Identifier: Apache-2.0
#include "bench/sweep.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "bench/temporary_folder.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/sweep/export.hpp"
#include "microswarm/sweep/message.hpp"
#include "microswarm/sweep/ranks.hpp"
#include "microswarm/sweep/sweep.hpp"
#include "microswarm/sweep/worker_pool.hpp"

namespace microswarm::bench {
namespace {

namespace fs = std::filesystem;
using Clock = Stop::Clock;

/// 100 cells of the first scenario, each of `trials` trials.
fs::path write_sweep(const fs::path& folder, const fs::path& scenarios, int trials) {
  const fs::path file = folder / "sweep.yaml";
  std::string values;
  for (int i = 0; i < 10; ++i) values += fmt::format("{}{}", i ? ", " : "", 45 + i);
  std::ofstream(file) << fmt::format(
      "name: bench\nscenario: {}\ngrid:\n  - key: navigator.clearance_um\n    values: [{}]\n"
      "  - key: navigator.extra_clearance_um\n    values: [5, 6, 7, 8, 9, 10, 11, 12, 13, 14]\n"
      "trials: {}\n",
      fs::absolute(scenarios / "first_flight.yaml").string(), values, trials);
  return file;
}

/// Seconds of a sweep of `trials` trials a cell, in this process.
double run_seconds(const fs::path& folder, const sweep::SweepPlan& plan, int jobs,
                   const Stop& stop) {
  const fs::path file = folder / fmt::format("run{}.db", jobs);
  fs::remove(file);
  sweep::SweepDatabase database(file, plan, {"here", "now"});
  const sweep::Ranks alone;
  sweep::RemoteWorkers workers(alone);
  const auto began = Clock::now();
  sweep::run_sweep(plan, database, workers, {.jobs = jobs, .progress = {}}, stop);
  return seconds_since(began);
}

/// Seconds of `count` processes at once that know nothing of one another, each with the whole sweep
/// and one thread.
double apart_seconds(const fs::path& folder, const fs::path& sweep, const fs::path& program,
                     int count) {
  std::string command;
  for (int i = 0; i < count; ++i) {
    const fs::path file = folder / fmt::format("apart{}.db", i);
    fs::remove(file);
    command += fmt::format("{} sweep {} --out {} --jobs 1 >/dev/null 2>&1 & ", program.string(),
                           sweep.string(), file.string());
  }
  const auto began = Clock::now();
  const int status = std::system((command + "wait").c_str());  // NOLINT(concurrency-mt-unsafe)
  return status == 0 ? seconds_since(began) : 0;
}

/// Seconds of the same by mpirun, with one thread a process, from the start of the program.
double mpirun_seconds(const fs::path& folder, const fs::path& sweep, const fs::path& program,
                      int ranks) {
  const fs::path file = folder / fmt::format("ranks{}.db", ranks);
  fs::remove(file);
  const std::string command = fmt::format(
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n {} {} "
      "sweep {} --out {} --jobs 1 >/dev/null 2>&1",
      ranks, program.string(), sweep.string(), file.string());
  const auto began = Clock::now();
  const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): one thread
  return status == 0 ? seconds_since(began) : 0;
}

std::vector<report::BenchRow> efficiency(const fs::path& folder, const fs::path& scenarios,
                                         const fs::path& program, bool quick, const Stop& stop) {
  const fs::path file = write_sweep(folder, scenarios, quick ? 1 : 10);
  const sweep::SweepPlan plan = sweep::load_sweep(file);
  std::vector<double> threads, ranks, apart;
  for (int k = 0; k < (quick ? 3 : 5) && !stop(); ++k) {
    threads.push_back(run_seconds(folder, plan, 1, stop) /
                      (2 * run_seconds(folder, plan, 2, stop)));
    apart.push_back(apart_seconds(folder, file, program, 1) /
                    apart_seconds(folder, file, program, 2));
    const double one = mpirun_seconds(folder, file, program, 1);
    const double two = mpirun_seconds(folder, file, program, 2);
    if (one > 0 && two > 0) ranks.push_back(one / (2 * two));
  }
  const std::string name = fmt::format("sweep of {} trials", 100 * plan.sweep.trials);
  std::vector<report::BenchRow> rows;
  const auto add = [&](const char* of, const std::vector<double>& ours) {
    rows.push_back({.name = name,
                    .quantity = fmt::format("efficiency of {}, median", of),
                    .unit = "",
                    .ours = quantile(ours, 0.5),
                    .peer = quantile(apart, 0.5),
                    .peer_name = "2 processes apart, each the whole sweep",
                    .aim = 0.95,
                    .at_most = false});
  };
  add("2 threads", threads);
  if (!ranks.empty()) add("2 ranks of mpirun, with their start", ranks);
  return rows;
}

/// Rows of all trials of a cell but the last one, as a trial gave them.
std::vector<sweep::SweepRow> sweep_rows(const sweep::SweepPlan& plan, std::uint32_t cell,
                                        const sweep::SweepRow& like) {
  std::vector<sweep::SweepRow> rows(static_cast<std::size_t>(plan.sweep.trials), like);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].task = {cell, static_cast<std::uint32_t>(i)};
  rows.pop_back();
  return rows;
}

/// Rows a second of SQLite alone: the same values by one prepared statement, as many a transaction.
double plain_rate(const fs::path& file, const sweep::SweepPlan& plan, const sweep::SweepRow& like) {
  const std::vector<sweep::SweepColumn> columns = sweep::sweep_columns(plan);
  SQLite::Database database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  std::string names, places;
  for (const sweep::SweepColumn& column : columns) {
    names += fmt::format("{} {}, ", sweep::sql_name(column.name), enum_name(column.kind));
    places += places.empty() ? "?" : ", ?";
  }
  database.exec("CREATE TABLE trials(" + names + "PRIMARY KEY(cell, trial)) WITHOUT ROWID");
  const auto began = Clock::now();
  std::size_t count = 0;
  for (std::uint32_t cell = 0; cell < plan.cells.size(); ++cell) {
    SQLite::Transaction whole(database);
    SQLite::Statement insert(database, "INSERT INTO trials VALUES(" + places + ")");
    for (const sweep::SweepRow& row : sweep_rows(plan, cell, like)) {
      std::vector<sweep::SqlValue> values = sweep::task_values(plan, columns, row.task);
      values.insert(values.end(), row.values.begin(), row.values.end());
      for (std::size_t i = 0; i < values.size(); ++i)
        std::visit(Overloaded{[&](std::monostate) { insert.bind(static_cast<int>(i + 1)); },
                              [&](const OneOf<std::int64_t, double, std::string> auto& v) {
                                insert.bind(static_cast<int>(i + 1), v);
                              }},
                   values[i]);
      insert.exec();
      insert.reset();
      ++count;
    }
    whole.commit();
  }
  return static_cast<double>(count) / seconds_since(began);
}

/// Seconds to decode a message of one row.
double seconds_one_by_one(const sweep::SweepRow& row) {
  constexpr int messages = 10'000;
  const std::string bytes = sweep::to_bytes(
      {.kind = sweep::SweepMessage::Kind::rows, .text = {}, .want = 1, .tasks = {}, .rows = {row}});
  std::size_t rows = 0;
  const auto began = Clock::now();
  for (int i = 0; i < messages; ++i) rows += sweep::parse_message(bytes).rows.size();
  if (rows != messages) throw std::runtime_error("bench: a message lost its row");
  return seconds_since(began) / messages;
}

std::vector<report::BenchRow> many_rows(const fs::path& folder, const fs::path& scenarios,
                                        bool quick, const Stop& stop) {
  const sweep::SweepPlan plan =
      sweep::load_sweep(write_sweep(folder, scenarios, quick ? 1000 : 10'000));
  const sweep::SweepRow like{{0, 0}, sweep::result_values(sweep::run_task(plan, {0, 0}, stop))};
  const fs::path file = folder / "many.db";
  sweep::SweepDatabase database(file, plan, {"here", "now"});
  double adding = 0, coding = 0;
  std::size_t count = 0;
  for (std::uint32_t cell = 0; cell < plan.cells.size() && !stop(); ++cell) {
    const std::vector<sweep::SweepRow> rows = sweep_rows(plan, cell, like);
    auto began = Clock::now();
    database.add(rows);
    adding += seconds_since(began);
    const std::string bytes = sweep::to_bytes({.kind = sweep::SweepMessage::Kind::rows,
                                               .text = {},
                                               .want = 1,
                                               .tasks = {},
                                               .rows = rows});
    began = Clock::now();
    if (sweep::parse_message(bytes).rows.size() != rows.size())
      throw std::runtime_error("bench: a message lost rows");
    coding += seconds_since(began);
    count += rows.size();
  }
  const double one_by_one = seconds_one_by_one(like);
  auto began = Clock::now();
  const std::size_t missing = database.missing().size();
  const double resuming = seconds_since(began);
  if (!stop() && missing != plan.cells.size())
    throw std::runtime_error("bench: rows are missing that were added");
  const sweep::SweepReader reader(file);
  began = Clock::now();
  const std::size_t csv = sweep::sweep_csv(reader).size();
  const double to_csv = seconds_since(began);
  began = Clock::now();
  const std::size_t hdf5 = sweep::sweep_hdf5(reader).size();
  const double to_hdf5 = seconds_since(began);
  if (csv == 0 || hdf5 == 0) throw std::runtime_error("bench: nothing was exported");

  const std::string name = fmt::format("database of {} rows", count);
  const auto n = static_cast<double>(count);
  return {{.name = name,
           .quantity = fmt::format("rows added a second, {} a transaction", plan.sweep.trials - 1),
           .unit = "1/s",
           .ours = n / adding,
           .peer = plain_rate(folder / "plain.db", plan, like),
           .peer_name = "SQLite, one prepared statement",
           .at_most = false},
          {.name = name,
           .quantity = "rows decoded from messages a second",
           .unit = "1/s",
           .ours = n / coding,
           .at_most = false},
          {.name = name,
           .quantity = "the same, one row a message",
           .unit = "1/s",
           .ours = 1 / one_by_one,
           .at_most = false},
          {.name = name,
           .quantity = "rows rank 0 takes in a second: decoded and added",
           .unit = "1/s",
           .ours = n / (coding + adding),
           .at_most = false},
          {.name = name, .quantity = "finding what is missing", .unit = "s", .ours = resuming},
          {.name = name, .quantity = "export as CSV", .unit = "s", .ours = to_csv},
          {.name = name, .quantity = "export as HDF5", .unit = "s", .ours = to_hdf5}};
}

}  // namespace

std::vector<report::BenchRow> sweep(const fs::path& scenarios, const fs::path& program, bool quick,
                                    const Stop& stop) {
  const TemporaryFolder folder;
  std::vector<report::BenchRow> rows = many_rows(folder.path(), scenarios, quick, stop);
  for (report::BenchRow& row : efficiency(folder.path(), scenarios, program, quick, stop))
    rows.push_back(std::move(row));
  return rows;
}

}  // namespace microswarm::bench
