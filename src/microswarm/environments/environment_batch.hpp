// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/environments/environment_step.hpp"

namespace microswarm::environments {

/// When an environment whose episode has ended begins the next one.
enum class Autoreset {
  next_step,  ///< with the following step, whose input has no effect and whose reward is 0
  same_step,  ///< with the step that ended it, after its last observation is kept
  disabled    ///< when it is reset; a step before is refused
};

/// Environments of the same task, stepped together on several threads. Results do not depend on the
/// number of threads: environment i of a batch with seed s equals a batch of one with seed s + i.
/// Each writes its observation of `size` numbers into the batch's.
template <class Episode, class Number>
class EnvironmentBatch {
 public:
  /// `threads` of 0: one a core. The task must outlive this.
  template <class Task>
  EnvironmentBatch(const Task& task, std::size_t count, std::size_t size, std::uint64_t seed,
                   int threads, Autoreset autoreset = Autoreset::next_step)
      : EnvironmentBatch(count, size, threads, autoreset) {
    for (std::size_t i = 0; i < count; ++i) episodes_.emplace_back(task, seed + i, of(i));
  }
  /// Environments of the same task in the same state, which continue independently. Throws
  /// InputError after a call that was stopped.
  EnvironmentBatch(const EnvironmentBatch& other)
      : EnvironmentBatch(other.count(), other.size(), other.jobs_, other.autoreset_) {
    other.check_whole();
    for (std::size_t i = 0; i < other.count(); ++i)
      episodes_.emplace_back(other.episodes_[i], of(i));
    made_ = other.made_;
    std::ranges::copy(*other.observations_, observations_->begin());
    final_ = other.final_;
  }
  EnvironmentBatch& operator=(const EnvironmentBatch&) = delete;

  /// Begins an episode in each: the first of the seeds s + i, or the next. After a stop only this
  /// reset is allowed.
  void reset(std::optional<std::uint64_t> seed = {}, const Stop& stop = {}) {
    for_each(stop,
             [&](std::size_t i) { reset_one(i, seed ? std::optional(*seed + i) : std::nullopt); });
  }
  /// Begins an episode in each whose `mask` is not 0, of its seed or the next. Both spans have
  /// count() values. Throws InputError after a call that was stopped, unless all are reset.
  void reset(std::span<const std::optional<std::uint64_t>> seeds,
             std::span<const std::uint8_t> mask, const Stop& stop = {}) {
    if (std::ranges::find(mask, std::uint8_t{0}) != mask.end()) check_whole();
    for_each(stop, [&](std::size_t i) {
      if (mask[i] != 0) reset_one(i, seeds[i]);
    });
  }
  /// Steps each environment with the input `action(i)`. An environment whose episode has ended
  /// begins the next one as `Autoreset` says. The spans have count() values; `copy` is empty or has
  /// the size of the observations, which are copied into it. Throws InputError after a call that
  /// was stopped, and for an ended episode that is not reset.
  template <class Action>
  void step(Action&& action, std::span<double> rewards, std::span<std::uint8_t> terminated,
            std::span<std::uint8_t> truncated, std::span<Number> copy = {}, const Stop& stop = {}) {
    check_whole();
    if (autoreset_ == Autoreset::disabled) check_running();
    for_each(stop, [&](std::size_t i) {
      EnvironmentStep& made = made_[i];
      if (made.has_ended() && autoreset_ == Autoreset::next_step)
        reset_one(i, {});
      else
        made = episodes_[i].step(action(i));
      rewards[i] = made.reward;
      terminated[i] = made.terminated;
      truncated[i] = made.truncated;
      if (made.has_ended() && autoreset_ == Autoreset::same_step) {
        std::ranges::copy(of(i), final_.begin() + static_cast<std::ptrdiff_t>(i * size()));
        episodes_[i].reset();
      }
      if (!copy.empty()) std::ranges::copy(of(i), copy.data() + i * size());
    });
  }
  /// Brings each environment into a state that Episode::state() gave. There are count() of them.
  /// Throws InputError for a state that cannot be.
  template <class States>
  void restore(const States& states, const Stop& stop = {}) {
    for_each(stop, [&](std::size_t i) { made_[i] = episodes_[i].restore(states[i]); });
  }

  std::size_t count() const { return made_.size(); }
  /// Numbers of an observation.
  std::size_t size() const { return observations_->size() / count(); }
  Autoreset autoreset() const { return autoreset_; }
  Episode& episode(std::size_t index) { return episodes_[index]; }
  const Episode& episode(std::size_t index) const { return episodes_[index]; }
  /// Result of the last step; of a reset one without a reason.
  const EnvironmentStep& made(std::size_t index) const { return made_[index]; }
  /// Last observation of the episode that ended with the last step (`same_step`).
  std::span<const Number> final_observation(std::size_t index) const {
    return std::span(final_).subspan(index * size(), size());
  }
  /// Observations in sequence; they may outlive this object.
  const std::shared_ptr<std::vector<Number>>& observations() const { return observations_; }
  /// Throws InputError after a call that was stopped.
  void check_whole() const {
    if (was_stopped_) throw InputError("the last call was interrupted: a reset is needed");
  }

 private:
  EnvironmentBatch(std::size_t count, std::size_t size, int threads, Autoreset autoreset)
      : observations_(std::make_shared<std::vector<Number>>(count * size)),
        made_(count),
        final_(autoreset == Autoreset::same_step ? count * size : 0),
        autoreset_(autoreset),
        jobs_(threads),
        threads_(threads) {
    episodes_.reserve(count);
  }
  std::span<Number> of(std::size_t i) {
    return std::span(*observations_).subspan(i * size(), size());
  }
  void reset_one(std::size_t i, std::optional<std::uint64_t> seed) {
    if (seed)
      episodes_[i].reset(*seed);
    else
      episodes_[i].reset();
    made_[i] = {};
  }
  void check_running() const {
    const auto ended = std::ranges::find_if(made_, &EnvironmentStep::has_ended);
    if (ended != made_.end())
      throw InputError("the episode of environment " + std::to_string(ended - made_.begin()) +
                       " has ended, and autoreset is disabled: a reset is needed");
  }
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
  std::vector<EnvironmentStep> made_;
  std::vector<Number> final_;
  Autoreset autoreset_;
  int jobs_;
  bool was_stopped_ = false;
  ThreadTeam threads_;
};

}  // namespace microswarm::environments
