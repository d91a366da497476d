// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/clock_reading.hpp"

#include <sys/timex.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"

namespace microswarm::rig {
namespace {

std::string boot_id() {
  try {
    std::string id = read_file("/proc/sys/kernel/random/boot_id");
    while (!id.empty() && id.back() == '\n') id.pop_back();
    return id;
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

ClockReading read_clocks() {
  static const std::string boot = boot_id();
  using Clock = std::chrono::system_clock;
  timespec up{};
  ::clock_gettime(CLOCK_BOOTTIME, &up);
  timex state{};
  const bool synchronised = ::adjtimex(&state) >= 0 && (state.status & STA_UNSYNC) == 0;
  return {std::chrono::duration<double>(Clock::now().time_since_epoch()).count(),
          static_cast<double>(up.tv_sec) + 1e-9 * static_cast<double>(up.tv_nsec), boot,
          synchronised};
}

double certain_pause(const ClockReading& then, const ClockReading& now) {
  const double wall = std::max(0.0, now.wall - then.wall);
  if (then.boot.empty() || now.boot.empty()) return wall;
  if (then.boot == now.boot) return std::max(0.0, std::min(wall, now.uptime - then.uptime));
  return std::max(then.synchronised && now.synchronised ? wall : 0, now.uptime);
}

}  // namespace microswarm::rig
