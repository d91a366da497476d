// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>

#include "microswarm/sweep/message.hpp"
#include "microswarm/sweep/ranks.hpp"
#include "microswarm/sweep/sweep_database.hpp"

namespace microswarm::sweep {

/// Progress of a sweep, in trials.
struct SweepProgress {
  std::size_t before = 0;  ///< with rows when this run began
  std::size_t added = 0;   ///< with rows from this run
  std::size_t left = 0;    ///< without rows
};

/// Options of `run_sweep`.
struct SweepOptions {
  int jobs = 0;  ///< threads of this process; 0: one a core
  /// Called after rows are added and periodically, in the caller's thread.
  std::function<void(const SweepProgress&)> progress{};
};

/// Rank 0's view of the worker processes. Construct it before anything that can throw: the
/// destructor shuts the workers down.
class RemoteWorkers {
 public:
  explicit RemoteWorkers(const Ranks& ranks);
  ~RemoteWorkers();
  RemoteWorkers(const RemoteWorkers&) = delete;
  RemoteWorkers& operator=(const RemoteWorkers&) = delete;

  bool any() const { return ranks_.count() > 1; }
  /// Rows received since the last call. Throws InputError when a worker failed to start or has
  /// read input whose plan has another hash.
  std::vector<SweepRow> take(const std::string& plan_hash);
  /// Sends tasks from `next(n)`, at most n, to the workers that have room.
  void dispatch(const std::function<std::vector<SweepTask>(std::size_t)>& next);
  /// Whether a worker was asked to stop.
  bool stopped() const { return stopped_; }
  /// Ends the workers and waits for them; returns their last rows.
  std::vector<SweepRow> shutdown();

 private:
  void handle(int from, SweepMessage message, const std::string& plan_hash);

  const Ranks& ranks_;
  std::map<int, std::size_t> wanted_;  ///< tasks a rank has room for
  std::vector<SweepRow> rows_;
  std::string failure_;
  bool stopped_ = false;
  int at_work_ = 0;
};

/// Runs all trials missing from the store, in this process and in the workers, and adds the rows
/// as they arrive. Apart from wall-clock times the rows do not depend on the number of threads and
/// processes. When stopped, only trials in flight are lost.
SweepProgress run_sweep(const SweepPlan& plan, SweepStore& store, RemoteWorkers& workers,
                        const SweepOptions& options = {}, const Stop& stop = {});

/// Main loop of a worker process: runs the tasks that rank 0 sends until rank 0 ends it.
void run_sweep_worker(const Ranks& ranks, const std::filesystem::path& file, int jobs,
                      const Stop& stop = {});

}  // namespace microswarm::sweep
