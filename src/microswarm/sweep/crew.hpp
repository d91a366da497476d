// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "microswarm/sweep/table.hpp"

namespace microswarm {

/// Runs one trial of a sweep: the same bits as the trial of that number of run_trials.
TrialResult run_task(const SweepPlan& plan, const SweepTask& task, const Stop& stop = {});

/// Threads of one process that run trials as they are given. The destructor breaks off the trials
/// that still run and waits for the threads.
class SweepCrew {
 public:
  /// `jobs` threads; 0: one a core. The plan must outlive it.
  SweepCrew(const SweepPlan& plan, int jobs);
  ~SweepCrew();
  SweepCrew(const SweepCrew&) = delete;
  SweepCrew& operator=(const SweepCrew&) = delete;

  /// How many more trials it should be given so that no thread waits: few as long as that does, and
  /// more from each time on when threads had to wait although it had been given enough.
  std::size_t room() const { return enough_ > in_hand_ ? enough_ - in_hand_ : 0; }

  void give(std::span<const SweepTask> tasks);
  /// The rows of trials that have ended; waits for the first, but no longer than `patience`. Throws
  /// what a trial threw.
  std::vector<SweepRow> take(std::chrono::milliseconds patience);

 private:
  void work();

  const SweepPlan& plan_;
  int jobs_;
  std::size_t in_hand_ = 0;  ///< given, and their rows not taken
  std::size_t enough_;
  std::atomic<bool> halt_{false};
  std::mutex mutex_;
  std::condition_variable given_, ended_;
  std::deque<SweepTask> tasks_;
  std::vector<SweepRow> rows_;
  std::exception_ptr thrown_;
  std::jthread runner_;  // last: it uses all the others
};

}  // namespace microswarm
