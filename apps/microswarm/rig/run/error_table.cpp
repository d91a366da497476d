// SPDX-License-Identifier: Apache-2.0
// `rig simulate --errors`: runs through a simulated rig with errors that its file does not know.
#include "rig/run/error_table.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"
#include "microswarm/rig/session/open_on_rig.hpp"
#include "microswarm/rig/simulation/rig_errors.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

/// The trials of one pair with one error; `refused` if it does not begin.
struct ErrorTrials {
  std::vector<rig::RigTrial> trials;
  std::string refused;
};

std::vector<std::string> joined(std::vector<std::string> settings,
                                const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

ErrorTrials run_with(const RigPair& pair, const rig::RigError& error, int trials, int jobs,
                     const Context& context) {
  ErrorTrials out;
  try {
    const rig::RigExperiment on =
        rig::open_rig_experiment(pair.scenario, {pair.settings, "--set"}, pair.rig,
                                 {joined(pair.rig_settings, error.rig_settings), "--set-rig"});
    rig::require_field(on.rig);
    rig::require_simulated_map(on);
    std::vector<std::optional<rig::RigTrial>> results(static_cast<std::size_t>(trials));
    std::mutex mutex;
    int done = 0;
    ProgressBar bar(std::string(error.name));
    for_each_index(results.size(), jobs, [&](std::size_t i) {
      if (context.stop()) return;
      rig::RigTrial trial = rig::run_on_rig(on, static_cast<std::uint32_t>(i), context.stop);
      if (context.stop()) return;
      results[i] = std::move(trial);
      const std::lock_guard lock(mutex);
      bar.update(++done / static_cast<double>(trials));
    });
    for (std::optional<rig::RigTrial>& trial : results)
      if (trial) out.trials.push_back(std::move(*trial));
  } catch (const InputError& e) {
    if (&error == rig::rig_errors().data()) throw;  // without an error it must run
    out.refused = e.what();
  }
  return out;
}

/// Message about these trials: that an arrival was only believed, or the first fault or note.
std::string message_of(const ErrorTrials& of) {
  if (!of.refused.empty()) return "refused: " + of.refused;
  if (std::ranges::any_of(of.trials, &rig::RigTrial::is_believed)) return "ARRIVAL ONLY BELIEVED";
  for (const rig::RigTrial& trial : of.trials)
    if (!trial.fault.empty()) return trial.fault;
  for (const rig::RigTrial& trial : of.trials)
    if (!trial.notes.empty()) return "note: " + trial.notes.front();
  return {};
}

void print_row(std::string_view name, const ErrorTrials& of) {
  std::vector<double> times;
  int arrived = 0, contacts = 0;
  double error = 0;
  for (const rig::RigTrial& trial : of.trials) {
    if (trial.arrived && trial.result.status == Status::solved) {
      ++arrived;
      times.push_back(trial.result.metrics.time);
    }
    contacts += static_cast<int>(trial.result.metrics.contacts);
    error = std::max(error, trial.position_error);
  }
  print("  {:<26} {:>2} of {:<2} {:>8} {:>8} {:>11}   {}\n", name, arrived, of.trials.size(),
        times.empty() ? "–" : fmt::format("{:.1f}", median(times)), contacts,
        error > 0 ? fmt::format("{:.1f}", error) : "–", message_of(of));
  flush_output();
}

}  // namespace

int simulate_errors(const std::vector<RigPair>& pairs, int trials, int jobs, const std::string& out,
                    const Context& context) {
  const OutFolder hold(out);
  std::vector<rig::RigErrorRow> rows;
  int believed = 0;
  print("  {:<26} {:>8} {:>8} {:>8} {:>11}   {}\n", "error of the rig", "arrived", "time s",
        "contacts", "position µm", "message");
  for (const RigPair& pair : pairs) {
    const std::string name = std::filesystem::path(pair.scenario).stem().string();
    print("{} × {}\n", name, std::filesystem::path(pair.rig).stem().string());
    for (const rig::RigError& error : rig::rig_errors()) {
      if (context.stop()) break;
      const ErrorTrials of = run_with(pair, error, trials, jobs, context);
      print_row(error.name, of);
      for (std::size_t k = 0; k < of.trials.size(); ++k)
        rows.push_back(rig::error_row(of.trials[k], static_cast<int>(k), name, error));
      if (!of.refused.empty())
        rows.push_back({.scenario = name,
                        .error = std::string(error.name),
                        .status = Status::fault,
                        .fault = of.refused});
      believed += static_cast<int>(std::ranges::count_if(of.trials, &rig::RigTrial::is_believed));
    }
  }
  if (!out.empty()) {
    const std::filesystem::path table = std::filesystem::path(out) / "errors.csv";
    write_file_atomically(table, io::csv_table(rows));
    print("wrote {}\n", table.string());
  }
  if (context.stop()) print("interrupted\n");
  if (believed > 0)
    note("note: {} runs ended as arrived while the swarm was elsewhere\n", believed);
  return believed > 0 || context.stop() ? not_reached : ok;
}

}  // namespace microswarm::cli
