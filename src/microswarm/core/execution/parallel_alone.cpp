// SPDX-License-Identifier: Apache-2.0
// The build without threads.
#include "microswarm/core/execution/parallel.hpp"

namespace microswarm {

/// Nothing: no thread helps.
class ThreadTeam::Loop {};

ThreadTeam::ThreadTeam(int) {}

ThreadTeam::~ThreadTeam() = default;

void ThreadTeam::for_each_index(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body) {
  ThreadTeam(jobs).for_each_index(count, body);
}

}  // namespace microswarm
