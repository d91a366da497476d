// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/worker_pool.hpp"

#include <algorithm>
#include <utility>

#include "microswarm/core/execution/parallel.hpp"

namespace microswarm::sweep {

namespace {
constexpr std::size_t max_ahead = 64;  // trials a thread
}  // namespace

experiment::TrialResult run_task(const SweepPlan& plan, const SweepTask& task, const Stop& stop) {
  const SweepCell& cell = plan.cells[task.cell];
  return experiment::trial_result(cell.scenario, cell.world, task.trial, stop);
}

WorkerPool::WorkerPool(const SweepPlan& plan, int jobs)
    : plan_(plan),
      jobs_(jobs > 0 ? jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))),
      enough_(2 * static_cast<std::size_t>(jobs_)),
      runner_([this] {
        for_each_index(static_cast<std::size_t>(jobs_), jobs_, [this](std::size_t) { work(); });
      }) {}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    halt_ = true;
  }
  given_.notify_all();
}

void WorkerPool::give(std::span<const SweepTask> tasks) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.insert(tasks_.end(), tasks.begin(), tasks.end());
  }
  in_hand_ += tasks.size();
  given_.notify_all();
}

std::vector<SweepRow> WorkerPool::take(std::chrono::milliseconds poll_timeout) {
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, poll_timeout, [this] { return !rows_.empty() || thrown_; });
  if (thrown_) std::rethrow_exception(thrown_);
  std::vector<SweepRow> rows = std::exchange(rows_, {});
  const auto jobs = static_cast<std::size_t>(jobs_);
  const bool waited = in_hand_ >= enough_ && in_hand_ - rows.size() < jobs;
  if (waited) enough_ = std::min(2 * enough_, max_ahead * jobs);
  in_hand_ -= rows.size();
  return rows;
}

void WorkerPool::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    given_.wait(lock, [this] { return halt_ || !tasks_.empty(); });
    if (halt_) return;
    const SweepTask task = tasks_.front();
    tasks_.pop_front();
    lock.unlock();
    SweepRow row{task, {}};
    std::exception_ptr thrown;
    try {
      row.values = result_values(run_task(plan_, task, Stop(&halt_)));
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    if (halt_) return;
    if (thrown) thrown_ = thrown;
    rows_.push_back(std::move(row));
    ended_.notify_one();
  }
}

}  // namespace microswarm::sweep
