// SPDX-License-Identifier: Apache-2.0
// Runs a scenario from its file, prints its metrics and keeps the record.
#include <cstdio>
#include <cstdlib>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/session/session.hpp"

int main(int argc, char** argv) {
  using namespace microswarm;
  const char* scenarios = std::getenv("MICROSWARM_SCENARIOS");
  const std::filesystem::path folder = scenarios ? scenarios : "scenarios";
  try {
    const auto session = experiment::open_session(argc > 1 ? argv[1] : folder / "first_flight.yaml",
                                                  {"navigator.speed_um_per_s=50"});
    const experiment::RunResult& result = session->finish();
    std::printf("%s after %.1f s, %.0f µm; nearest wall %.1f µm\n", to_string(result.status).data(),
                result.metrics.time, result.metrics.length, result.metrics.walls.clearance);
    session->record_to("02_run.h5");  // MATLAB: h5read("02_run.h5", "/frames/x_um")
    return result.status == Status::solved ? 0 : 3;
  } catch (const InputError& error) {  // a line for each thing wrong
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
