// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>

#include <cstdlib>

namespace microswarm {

/// A mutex between threads of unlike priority: the thread that holds it inherits the real-time
/// priority of one that waits for it (PTHREAD_PRIO_INHERIT), so that no third one delays both.
/// Condition variables for it are std::condition_variable_any.
class InheritingMutex {
 public:
  InheritingMutex() {
    pthread_mutexattr_t attributes;
    ::pthread_mutexattr_init(&attributes);
    ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    ::pthread_mutex_init(&mutex_, &attributes);
    ::pthread_mutexattr_destroy(&attributes);
  }
  ~InheritingMutex() { ::pthread_mutex_destroy(&mutex_); }
  InheritingMutex(const InheritingMutex&) = delete;
  InheritingMutex& operator=(const InheritingMutex&) = delete;

  void lock() {
    if (::pthread_mutex_lock(&mutex_) != 0) std::abort();  // never without the lock
  }
  bool try_lock() { return ::pthread_mutex_trylock(&mutex_) == 0; }
  void unlock() { ::pthread_mutex_unlock(&mutex_); }

 private:
  pthread_mutex_t mutex_{};
};

}  // namespace microswarm
