// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>

namespace microswarm {

/// Gives the calling thread a real-time priority (SCHED_RR, 1 to 99) until the object's end. 0, or
/// a thread that has at least this priority, changes nothing.
class RealtimePriority {
 public:
  /// Whether threads that the thread starts have its priority, too.
  enum class Inherited { yes, no };
  explicit RealtimePriority(int priority, Inherited inherited = Inherited::yes);
  ~RealtimePriority();
  RealtimePriority(const RealtimePriority&) = delete;
  RealtimePriority& operator=(const RealtimePriority&) = delete;

  /// Whether the system permits it to this user.
  bool is_permitted() const { return is_permitted_; }

 private:
  bool is_permitted_ = true;
  bool is_raised_ = false;
  int reset_ = 0;  // flag of the policy
  pthread_t thread_ = ::pthread_self();
};

/// Real-time priority of the calling thread; 0 for none.
int realtime_priority();

/// Takes a real-time priority from the calling thread and lowers its usual one, for work that must
/// not hold up other threads.
void lower_priority();

}  // namespace microswarm
