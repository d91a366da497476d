// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>

namespace microswarm {

#ifdef _LIBCPP_HAS_NO_THREADS
/// Locks nothing: the standard library has no threads, as in WebAssembly.
struct Mutex {
  void lock() {}
  void unlock() {}
};
using RecursiveMutex = Mutex;
#else
/// A mutex.
using Mutex = std::mutex;
using RecursiveMutex = std::recursive_mutex;
#endif

}  // namespace microswarm
