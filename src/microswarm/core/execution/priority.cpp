// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/priority.hpp"

#include <sched.h>
#include <sys/resource.h>

namespace microswarm {
namespace {

/// Of the calling thread, which 0 names.
bool set(int policy, int priority) {
  sched_param param{};
  param.sched_priority = priority;
  return ::sched_setscheduler(0, policy, &param) == 0;
}

}  // namespace

int realtime_priority() {
  sched_param param{};
  ::sched_getparam(0, &param);
  return param.sched_priority;
}

RealtimePriority::RealtimePriority(int priority, Inherited inherited) {
  if (priority <= realtime_priority()) return;
  if (inherited == Inherited::no) reset_ = SCHED_RESET_ON_FORK;
  is_raised_ = is_permitted_ = set(SCHED_RR | reset_, priority);
}

RealtimePriority::~RealtimePriority() {
  if (is_raised_ && ::pthread_equal(thread_, ::pthread_self())) set(SCHED_OTHER | reset_, 0);
}

void lower_priority() {
  constexpr int niceness = 10;
  set(SCHED_OTHER, 0);
  ::setpriority(PRIO_PROCESS, 0, niceness);  // of this thread only, on Linux
}

}  // namespace microswarm
