// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/rig_priority.hpp"

#include <fmt/core.h>

namespace microswarm::rig {

RigPriority::RigPriority(const Rig& rig) : priority_(rig.params.realtime_priority) {
  if (!priority_.is_permitted())
    throw rig.keys.error("realtime_priority",
                         fmt::format("the system does not permit the real-time priority {} to this "
                                     "user (`ulimit -r` is the highest); 0 asks for none",
                                     rig.params.realtime_priority));
}

int urgent_priority(const Rig& rig) {
  const int priority = rig.params.realtime_priority;
  return priority > 0 ? priority + 1 : 0;
}

}  // namespace microswarm::rig
