// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/text/file.hpp"
#include "microswarm/sweep/sweep.hpp"
#include "tests/experiment/scenes.hpp"

namespace microswarm::sweep {

/// A sweep of 2 × 2 values and 2 methods, `trials` each, whose scenario stands beside it.
inline std::string sweep_text(int trials = 3) {
  return "name: some flights\n"
         "scenario: flight.yaml\n"
         "set: [time_limit_s=20]\n"
         "grid:\n"
         "  - key: navigator.clearance_um\n"
         "    values: [60, 90.5]\n"
         "  - {key: goal_um, values: [\"[700, 500]\", \"[800, 600]\"]}\n"
         "methods:\n"
         "  - {name: straight on, set: [navigator.guide=straight]}\n"
         "  - {name: route, set: [navigator.guide=route, navigator.horizon_s=2]}\n"
         "trials: " +
         std::to_string(trials) + "\nseed: 7\n";
}

/// An empty folder with the sweep in sweep.yaml.
inline std::filesystem::path sweep_folder(const std::string& name, const std::string& text) {
  const auto folder = experiment::empty_folder(name);
  write_file_atomically(folder / "flight.yaml",
                        experiment::scenario_text(experiment::small_flight()));
  write_file_atomically(folder / "sweep.yaml", text);
  return folder;
}

/// Runs what a database has not, alone.
inline SweepProgress run_alone(const SweepPlan& plan, const std::filesystem::path& file, int jobs,
                               const Stop& stop = {}) {
  const Ranks ranks;
  RemoteWorkers workers(ranks);
  SweepDatabase database(file, plan, {"host", "2026-01-31 12:00:00"});
  return run_sweep(plan, database, workers, {.jobs = jobs, .progress = {}}, stop);
}

/// All rows of a database but for wall-clock times.
inline std::vector<std::vector<SqlValue>> physical_rows(const std::filesystem::path& file) {
  const SweepReader reader(file);
  std::vector<std::vector<SqlValue>> rows;
  reader.each_row([&](std::span<const SqlValue> row) {
    rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i)
      if (reader.columns()[i].role != SweepColumn::Role::wall_clock) rows.back().push_back(row[i]);
  });
  return rows;
}

}  // namespace microswarm::sweep
