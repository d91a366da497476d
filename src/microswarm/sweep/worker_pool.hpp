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

namespace microswarm::sweep {

/// Runs one trial of a sweep; identical to the trial of that number in `run_trials`.
experiment::TrialResult run_task(const SweepPlan& plan, const SweepTask& task,
                                 const Stop& stop = {});

/// Threads of one process that run queued trials. The destructor cancels running trials and joins
/// the threads.
class WorkerPool {
 public:
  /// `jobs` threads; 0: one a core. The plan must outlive it.
  WorkerPool(const SweepPlan& plan, int jobs);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Number of further trials to queue so that no thread idles. The queue's target length doubles
  /// whenever threads idled although the queue had been full.
  std::size_t room() const { return enough_ > in_hand_ ? enough_ - in_hand_ : 0; }

  void give(std::span<const SweepTask> tasks);
  /// Rows of finished trials; waits for the first at most `poll_timeout`. Rethrows what a trial
  /// threw.
  std::vector<SweepRow> take(std::chrono::milliseconds poll_timeout);

 private:
  void work();

  const SweepPlan& plan_;
  int jobs_;
  std::size_t in_hand_ = 0;  ///< trials given whose rows were not taken
  std::size_t enough_;
  std::atomic<bool> halt_{false};
  std::mutex mutex_;
  std::condition_variable given_, ended_;
  std::deque<SweepTask> tasks_;
  std::vector<SweepRow> rows_;
  std::exception_ptr thrown_;
  std::jthread runner_;  // last: it uses the other members
};

}  // namespace microswarm::sweep
