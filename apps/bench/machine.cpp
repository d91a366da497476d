// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <fstream>

#include "bench/ompl_peer.hpp"
#include "bench/planning.hpp"
#include "microswarm/core/version.hpp"

namespace microswarm::bench {
namespace {

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown CPU";
}

}  // namespace

std::string machine_line() {
  const char* commit = std::getenv("MICROSWARM_COMMIT");
  return fmt::format("{}, gcc {}, microswarm {}{}, OMPL {}, {:%Y-%m-%d}", cpu_name(), __VERSION__,
                     version, commit ? fmt::format(" of commit {}", commit) : "", ompl_version(),
                     fmt::gmtime(std::time(nullptr)));
}

}  // namespace microswarm::bench
