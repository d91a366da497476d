// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/environments/environment_step.hpp"

namespace microswarm::environments {

/// Environments of the same task, stepped together on several threads. Results do not depend on the
/// number of threads: environment i of a batch with seed s equals a batch of one with seed s + i.
/// Each writes its observation of `size` numbers into the batch's.
template <class Episode, class Number>
class EnvironmentBatch {
 public:
  /// `threads` of 0: one a core. The task must outlive this.
  template <class Task>
  EnvironmentBatch(const Task& task, std::size_t count, std::size_t size, std::uint64_t seed,
                   int threads)
      : observations_(std::make_shared<std::vector<Number>>(count * size)),
        has_ended_(count),
        threads_(threads) {
    episodes_.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
      episodes_.emplace_back(task, seed + i, std::span(*observations_).subspan(i * size, size));
  }

  /// Begins an episode in each: the first of the seeds s + i, or the next. After a stop only a
  /// reset is allowed.
  void reset(std::optional<std::uint64_t> seed = {}, const Stop& stop = {}) {
    for_each(stop, [&](std::size_t i) {
      if (seed)
        episodes_[i].reset(*seed + i);
      else
        episodes_[i].reset();
      has_ended_[i] = 0;
    });
  }
  /// Steps each environment with the input `action(i)`. An environment whose episode ended with the
  /// previous step begins the next episode instead, with a reward of 0. The spans have count()
  /// values; `copy` is empty or has the size of the observations, which are copied into it. Throws
  /// InputError after a call that was stopped.
  template <class Action>
  void step(Action&& action, std::span<double> rewards, std::span<std::uint8_t> terminated,
            std::span<std::uint8_t> truncated, std::span<Number> copy = {}, const Stop& stop = {}) {
    if (was_stopped_) throw InputError("the last call was interrupted: a reset is needed");
    for_each(stop, [&](std::size_t i) {
      EnvironmentStep made;
      if (has_ended_[i] != 0)
        episodes_[i].reset();
      else
        made = episodes_[i].step(action(i));
      rewards[i] = made.reward;
      terminated[i] = made.terminated;
      truncated[i] = made.truncated;
      has_ended_[i] = made.terminated || made.truncated;
      if (copy.empty()) return;
      const std::size_t size = observations_->size() / count();
      std::copy_n(observations_->data() + i * size, size, copy.data() + i * size);
    });
  }

  std::size_t count() const { return episodes_.size(); }
  Episode& episode(std::size_t index) { return episodes_[index]; }
  /// Observations in sequence; they may outlive this object.
  const std::shared_ptr<std::vector<Number>>& observations() const { return observations_; }

 private:
  template <class Body>
  void for_each(const Stop& stop, Body&& body) {
    was_stopped_ = true;                  // remains set after an exception
    constexpr std::size_t together = 16;  // environments that a thread takes at once
    const std::size_t blocks = (count() + together - 1) / together;
    threads_.for_each_index(blocks, [&](std::size_t block) {
      const std::size_t end = std::min(count(), (block + 1) * together);
      for (std::size_t i = block * together; i < end && !stop(); ++i) body(i);
    });
    was_stopped_ = stop();
  }

  std::shared_ptr<std::vector<Number>> observations_;
  std::vector<Episode> episodes_;
  std::vector<std::uint8_t> has_ended_;
  bool was_stopped_ = false;
  ThreadTeam threads_;
};

}  // namespace microswarm::environments
