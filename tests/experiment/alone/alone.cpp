// SPDX-License-Identifier: Apache-2.0
// Opens a scenario and steps it to its end. It is linked with microswarm::experiment alone.
#include <cstdio>
#include <exception>

#include "microswarm/experiment/session/session.hpp"

int main(int argc, char** argv) {
  try {
    if (argc != 2) return 2;
    const auto session = microswarm::experiment::open_session(argv[1]);
    const auto& result = session->finish();
    std::printf("%s after %g s, record %s\n", to_string(result.status).data(), result.metrics.time,
                session->record().hash().c_str());
    return result.status == microswarm::Status::solved ? 0 : 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
