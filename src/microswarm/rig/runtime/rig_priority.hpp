// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/execution/priority.hpp"
#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::rig {

/// Gives the calling thread, and those that it starts, the rig's `realtime_priority`.
class RigPriority {
 public:
  /// Throws InputError if the system does not permit it to this user.
  explicit RigPriority(const Rig& rig);

 private:
  RealtimePriority priority_;
};

/// Priority of what must not wait for ticks and pictures, the coils and all that stops them: one
/// more than the rig's; 0 for none.
int urgent_priority(const Rig& rig);

}  // namespace microswarm::rig
