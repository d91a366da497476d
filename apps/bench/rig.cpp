// SPDX-License-Identifier: Apache-2.0
#include "bench/rig.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "bench/temporary_folder.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm::bench {
namespace {

namespace fs = std::filesystem;

/// A thread for each core that only computes, until the object's end.
class BusyCores {
 public:
  BusyCores() {
    const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
    threads_.reserve(cores);
    for (unsigned k = 0; k < cores; ++k)
      threads_.emplace_back([](const std::stop_token& stop) {
        for (std::atomic<std::uint64_t> count = 0; !stop.stop_requested();) ++count;
      });
  }

 private:
  std::vector<std::jthread> threads_;
};

/// Options of the program, each with its key.
std::string assignments(const char* option, const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& one : settings) text += fmt::format(" {} '{}'", option, one);
  return text;
}

/// Latency of a run of `seconds` by the program, from its record.
experiment::RigLatency latency_of_program(const fs::path& program, const RigRun& run, int seconds) {
  const TemporaryFolder folder;
  const std::string command = fmt::format(
      "'{}' rig run '{}' --rig '{}'{}{} --seconds {} --out '{}' >/dev/null </dev/null",
      program.string(), run.scenario.string(), run.rig.string(), assignments("--set", run.settings),
      assignments("--set-rig", run.rig_settings), seconds, folder.path().string());
  const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): one thread
  const fs::path record = folder.path() / "run.h5";
  if (status >= 0 && fs::exists(record))
    if (const auto latency = experiment::read_record(record).rig_log.latency) return *latency;
  throw std::runtime_error(fmt::format("bench: this command drove nothing: {}", command));
}

/// Rows of a run; it has aims if nothing else is meant to hold it up.
void add_rows(std::vector<report::BenchRow>& rows, const std::string& name, bool has_aims,
              const experiment::RigLatency& latency) {
  const auto add = [&](const char* quantity, const char* unit, double ours,
                       std::optional<double> aim = {}) {
    rows.push_back({.name = name,
                    .quantity = quantity,
                    .unit = unit,
                    .ours = ours,
                    .aim = has_aims ? aim : std::nullopt});
  };
  add("camera to current, median", "ms", 1e3 * latency.median);
  add("camera to current, 99 of 100", "ms", 1e3 * latency.p99, 10);
  add("camera to current, longest", "ms", 1e3 * latency.longest);
  add("frames later than a tick", "", static_cast<double>(latency.late_currents), 0);
  add("missed deadlines", "", static_cast<double>(latency.missed_deadlines), 0);
}

}  // namespace

std::vector<report::BenchRow> rig(const fs::path& scenarios, const fs::path& program, bool quick,
                                  const Stop& stop) {
  const int seconds = quick ? 5 : 30;
  const RigRun usual{.scenario = scenarios / "papers/radar/single.yaml",
                     .rig = scenarios / "rigs/vortex.yaml",
                     .settings = {"tick_s=0.01", "map.hi_um=[2432, 1792]"},
                     .rig_settings = {"camera.microscope.um_per_px=4", "camera.rate_hz=100"}};
  RigRun urgent = usual;
  urgent.rig_settings.emplace_back("realtime_priority=10");
  std::vector<report::BenchRow> rows;
  const auto measure = [&](const char* what, bool has_aims, const RigRun& run, auto&& latency) {
    if (!stop()) add_rows(rows, fmt::format("{}, 100 Hz", what), has_aims, latency(run));
  };
  const auto by_program = [&](const RigRun& run) {
    return latency_of_program(program, run, seconds);
  };
  measure("rig run", true, usual, by_program);
#ifdef MICROSWARM_BENCH_LAB
  const auto in_lab = [&](const RigRun& run) { return latency_in_lab(run, seconds); };
  measure("lab with a page", true, usual, in_lab);
#endif
  const BusyCores busy;
  measure("rig run beside busy cores", false, usual, by_program);
  measure("rig run beside busy cores, realtime_priority", true, urgent, by_program);
#ifdef MICROSWARM_BENCH_LAB
  measure("lab beside busy cores, realtime_priority", true, urgent, in_lab);
#endif
  return rows;
}

}  // namespace microswarm::bench
