// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>

namespace microswarm {

/// Gives the calling thread a real-time priority (SCHED_RR, 1 to 98), which threads that it starts
/// inherit, until the object's end. 0, or a thread that has at least this priority, changes
/// nothing.
class RealtimePriority {
 public:
  explicit RealtimePriority(int priority);
  ~RealtimePriority();
  RealtimePriority(const RealtimePriority&) = delete;
  RealtimePriority& operator=(const RealtimePriority&) = delete;

  /// Whether the system permits it to this user.
  bool is_permitted() const { return is_permitted_; }

 private:
  bool is_permitted_ = true;
  bool is_raised_ = false;
  pthread_t thread_ = ::pthread_self();
};

/// Takes a real-time priority from the calling thread and lowers its usual one, for work that must
/// not hold up other threads.
void lower_priority();

}  // namespace microswarm
