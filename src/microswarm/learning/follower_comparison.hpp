// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/learning/follower_tasks.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm::learning {

/// Result of one follower on one task.
struct FollowedPath {
  bool arrived = false;
  double time = 0;            ///< [s]
  double fair_time = 0;       ///< path length divided by the task's speed [s]
  double rms_off = 0;         ///< root mean square distance from the path [µm]
  double max_off = 0;         ///< [µm]
  double field_turning = 0;   ///< mean rate of change of the commanded heading [rad/s]
  double fallback_share = 0;  ///< fraction of steps in which the learned follower used its fallback
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.arrived, plain("arrived", "1 if the end of the path was reached."));
    visit(self.time, s("time", "Time of the run."));
    visit(self.fair_time, s("way_over_speed", "Path length divided by the task's speed."));
    visit(self.rms_off, um("rms_off", "Root mean square distance from the path."));
    visit(self.max_off, um("most_off", "Greatest distance from the path."));
    visit(self.field_turning,
          deg_per_s("field_turning", "Mean rate of change of the commanded heading."));
    visit(self.fallback_share,
          plain("fallback_share", "Fraction of steps that used the fallback."));
  }
};

/// Results of one follower on all tasks.
struct FollowerOutcome {
  std::string name{};
  std::vector<FollowedPath> paths{};
};

/// Settings of `compare_followers`.
struct ComparisonOptions {
  int tasks = 200;
  FollowerTaskParams params{};
  std::uint64_t seed = 1;
  std::shared_ptr<const navigation::FollowerModel> model{};  ///< null: the built-in one
  int jobs = 0;                                              ///< threads; 0: one per core
  std::function<void(double share)> progress{};
};

/// Tasks from this number on are reserved for comparison and never used in training.
inline constexpr std::uint32_t first_unseen_task = 1U << 31;

/// Compares pure pursuit, pure pursuit with estimated-flow correction, the learned follower and the
/// expert. Each runs the same unseen tasks with the same noise in the same simulation until arrival
/// or the time limit. The swarm starts on the path. Both pure pursuits use the lookahead that is
/// best on separate tuning tasks.
std::vector<FollowerOutcome> compare_followers(const ComparisonOptions& options,
                                               const Stop& stop = {});

/// Distance of a follower from the path, tick by tick.
struct FollowerTrace {
  std::string name{};
  std::vector<double> off{};  ///< [µm]
};

/// Traces of all followers on one task.
std::vector<FollowerTrace> follow_one(const ComparisonOptions& options, std::uint32_t number);

/// A comparison task; `number` is at least first_unseen_task.
FollowerTask unseen_task(const ComparisonOptions& options, std::uint32_t number);

/// RMS distance from the path for each lookahead, averaged over tuning tasks; used to tune the
/// baseline.
struct LookaheadTuning {
  std::vector<double> lookahead{};  ///< [s]
  std::vector<double> rms_off{};    ///< [µm]
  /// Lookahead with the smallest distance [s].
  double best() const;
};
LookaheadTuning tune_lookahead(const ComparisonOptions& options,
                               const navigation::FollowerParams& follower, const Stop& stop = {});

}  // namespace microswarm::learning
