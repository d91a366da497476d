// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "microswarm/core/stop.hpp"
#include "microswarm/learning/follower_tasks.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm {

/// One task followed by one follower.
struct FollowedPath {
  bool arrived = false;
  double time = 0;            ///< [s]
  double fair_time = 0;       ///< way at the speed asked for [s]
  double rms_off = 0;         ///< root mean square distance from the path [µm]
  double max_off = 0;         ///< [µm]
  double field_turning = 0;   ///< of the commanded heading, a second [rad/s]
  double fallback_share = 0;  ///< of the steps in which the learned follower handed over
};

/// One of the followers compared, on every task.
struct FollowerOutcome {
  std::string name;
  std::vector<FollowedPath> paths;
};

/// What is compared on which tasks.
struct ComparisonOptions {
  int tasks = 200;
  FollowerTaskParams params;
  std::uint64_t seed = 1;
  std::shared_ptr<const FollowerModel> model;  ///< null: the built-in one
  int jobs = 0;                                ///< threads; 0 takes one a core
  std::function<void(double share)> progress;
};

/// Tasks from this number on are for comparing only: no training draws them.
inline constexpr std::uint32_t first_unseen_task = 1U << 31;

/// Pure pursuit, pure pursuit that steers against the flow it tells from what it sees, the learned
/// follower and the expert, each on the same unseen tasks with the same noise, in the same
/// simulation, until it arrives or the time limit ends it. The swarm starts on the path.
/// Both pure pursuits have the lookahead that does best on tasks of their own.
std::vector<FollowerOutcome> compare_followers(const ComparisonOptions& options,
                                               const Stop& stop = {});

/// How far a follower was off the path, tick by tick.
struct FollowerTrace {
  std::string name;
  std::vector<double> off;  ///< [µm]
};

/// One of the tasks for looking at.
std::vector<FollowerTrace> follow_one(const ComparisonOptions& options, std::uint32_t number);

/// A task that it compares on, of a number from first_unseen_task on.
FollowerTask unseen_task(const ComparisonOptions& options, std::uint32_t number);

/// Mean root mean square distance over some tuning tasks for each lookahead [s]: what the baseline
/// is tuned by.
struct LookaheadTuning {
  std::vector<double> lookahead;  ///< [s]
  std::vector<double> rms_off;    ///< [µm]
  double best() const;
};
LookaheadTuning tune_lookahead(const ComparisonOptions& options, const FollowerParams& follower,
                               const Stop& stop = {});

}  // namespace microswarm
