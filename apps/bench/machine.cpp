// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

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
  return fmt::format("{}, gcc {}, microswarm {}, OMPL {}", cpu_name(), __VERSION__, version,
                     ompl_version());
}

}  // namespace microswarm::bench
