// SPDX-License-Identifier: Apache-2.0
#include "bench/rig.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include "bench/temporary_folder.hpp"
#include "microswarm/experiment/record/record.hpp"

namespace microswarm::bench {
namespace {

namespace fs = std::filesystem;

/// Latency of a run of `seconds`, from its record.
experiment::RigLatency latency_of_run(const fs::path& scenarios, const fs::path& program,
                                      int seconds) {
  const TemporaryFolder folder;
  const std::string command = fmt::format(
      "'{}' rig run '{}' --rig '{}' --set tick_s=0.01 --set 'map.hi_um=[2432, 1792]' --set-rig "
      "camera.microscope.um_per_px=4 --set-rig camera.rate_hz=100 --seconds {} --out '{}' "
      ">/dev/null </dev/null",
      program.string(), (scenarios / "papers/radar/single.yaml").string(),
      (scenarios / "rigs/vortex.yaml").string(), seconds, folder.path().string());
  const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): one thread
  const fs::path record = folder.path() / "run.h5";
  if (status >= 0 && fs::exists(record))
    if (const auto latency = experiment::read_record(record).rig_log.latency) return *latency;
  throw std::runtime_error(fmt::format("bench: this command drove nothing: {}", command));
}

}  // namespace

std::vector<report::BenchRow> rig(const fs::path& scenarios, const fs::path& program, bool quick,
                                  const Stop& stop) {
  const experiment::RigLatency latency = latency_of_run(scenarios, program, quick ? 10 : 30);
  if (stop()) return {};
  const std::string name = "camera to current, 640 × 480 at 100 Hz";
  return {{.name = name,
           .quantity = "time a frame, median",
           .unit = "ms",
           .ours = 1e3 * latency.median},
          {.name = name,
           .quantity = "time a frame, 99 of 100",
           .unit = "ms",
           .ours = 1e3 * latency.p99,
           .aim = 10},
          {.name = name,
           .quantity = "time a frame, longest",
           .unit = "ms",
           .ours = 1e3 * latency.longest},
          {.name = name,
           .quantity = "frames later than a tick",
           .unit = "",
           .ours = static_cast<double>(latency.late_currents),
           .aim = 0},
          {.name = name,
           .quantity = "missed deadlines",
           .unit = "",
           .ours = static_cast<double>(latency.missed_deadlines),
           .aim = 0}};
}

}  // namespace microswarm::bench
