// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>

#include "microswarm/sweep/message.hpp"
#include "microswarm/sweep/ranks.hpp"
#include "microswarm/sweep/sweep_database.hpp"

namespace microswarm {

/// How far a sweep is, in trials.
struct SweepProgress {
  std::size_t before = 0;  ///< had their rows when this run began
  std::size_t added = 0;   ///< got theirs in this run
  std::size_t left = 0;    ///< have none yet
};

/// How to run a sweep.
struct SweepOptions {
  int jobs = 0;  ///< threads of this process; 0: one a core
  /// Called after rows were added and from time to time, in the caller's thread.
  std::function<void(const SweepProgress&)> progress;
};

/// The other processes of a sweep as the first one sees them. It must come to life before anything
/// that may fail: its destructor sends them home.
class SweepHelpers {
 public:
  explicit SweepHelpers(const Ranks& ranks);
  ~SweepHelpers();
  SweepHelpers(const SweepHelpers&) = delete;
  SweepHelpers& operator=(const SweepHelpers&) = delete;

  bool any() const { return ranks_.count() > 1; }
  /// Rows that came since, of all of them. Throws InputError when one could not begin, or has read
  /// other input than the plan of this hash.
  std::vector<SweepRow> take(const std::string& plan_hash);
  /// Gives tasks, which `next(n)` hands out, to those that have too few.
  void feed(const std::function<std::vector<SweepTask>(std::size_t)>& next);
  /// One of them was asked to stop.
  bool stopped() const { return stopped_; }
  /// Tells them that it is over and waits for them; the last rows that they had.
  std::vector<SweepRow> send_home();

 private:
  void hear(int from, SweepMessage message, const std::string& plan_hash);

  const Ranks& ranks_;
  std::map<int, std::size_t> wanted_;  ///< tasks that a rank has room for
  std::vector<SweepRow> rows_;
  std::string failure_;
  bool stopped_ = false;
  int at_work_ = 0;
};

/// Runs all trials that the database has not, here and in the helping processes, and adds each row
/// as it comes. The rows are the same for any number of threads and processes, but for wall-clock
/// times. Ends early when stopped; what was in flight then is lost, nothing else.
SweepProgress run_sweep(const SweepPlan& plan, SweepDatabase& database, SweepHelpers& helpers,
                        const SweepOptions& options = {}, const Stop& stop = {});

/// What every process but the first does: runs what the first one tells it, until it is sent home.
void help_sweep(const Ranks& ranks, const std::filesystem::path& file, int jobs,
                const Stop& stop = {});

}  // namespace microswarm
