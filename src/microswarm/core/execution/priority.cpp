// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/priority.hpp"

#include <sched.h>
#include <sys/resource.h>

namespace microswarm {
namespace {

bool set(int policy, int priority) {
  sched_param param{};
  param.sched_priority = priority;
  return ::pthread_setschedparam(::pthread_self(), policy, &param) == 0;
}

/// Real-time priority of the calling thread; 0 for none.
int priority_now() {
  int policy = SCHED_OTHER;
  sched_param param{};
  ::pthread_getschedparam(::pthread_self(), &policy, &param);
  return param.sched_priority;
}

}  // namespace

RealtimePriority::RealtimePriority(int priority) {
  if (priority <= priority_now()) return;
  is_raised_ = is_permitted_ = set(SCHED_RR, priority);
}

RealtimePriority::~RealtimePriority() {
  if (is_raised_ && ::pthread_equal(thread_, ::pthread_self())) set(SCHED_OTHER, 0);
}

void lower_priority() {
  constexpr int niceness = 10;
  set(SCHED_OTHER, 0);
  ::setpriority(PRIO_PROCESS, 0, niceness);  // of this thread only, on Linux
}

}  // namespace microswarm
