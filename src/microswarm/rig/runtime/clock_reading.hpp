// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace microswarm::rig {

/// A time that can be compared with one read by another process, also after a restart of the
/// computer.
struct ClockReading {
  double wall = 0;            ///< wall clock, since 1970 [s]
  double uptime = 0;          ///< since the computer started, also while suspended [s]
  std::string boot{};         ///< id of this start of the computer; empty if it is not known
  bool synchronised = false;  ///< whether the wall clock follows another clock, as by NTP
};

/// The clocks of this computer now.
ClockReading read_clocks();

/// Time that has passed for certain between two readings [s], at least 0. Within one start of the
/// computer a wall clock that was set forwards is not believed. Across a restart the wall clock
/// counts if it was synchronised both times; at least the time since the restart has passed.
double certain_pause(const ClockReading& then, const ClockReading& now);

}  // namespace microswarm::rig
