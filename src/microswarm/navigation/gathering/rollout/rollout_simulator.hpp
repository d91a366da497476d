// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/navigation/gathering/policies/aggregation_policy.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"

namespace microswarm {

/// All moves up to the end, with the merged robots before every 16th move.
struct RolloutPlan {
  static constexpr std::size_t checkpoint_interval = 16;
  std::vector<Vec2> moves;
  std::vector<MergedRobots> checkpoints;
};

/// Incomplete plan with the merged robots after its moves.
struct PartialPlan {
  MergedRobots merged;
  std::size_t from = 0;  ///< steps before its moves, a multiple of checkpoint_interval
  std::vector<Vec2> moves{};
  bool keeps_checkpoints = false;
  std::vector<MergedRobots> checkpoints{};

  std::size_t steps() const { return from + moves.size(); }
};

/// Simulates continuations of a plan and counts the work. `most` is the maximum number of steps of
/// the partial plan.
class RolloutSimulator {
 public:
  /// Map and stepper must outlive it.
  RolloutSimulator(const AggregationMap& map, const RobotStepper& stepper,
                   const AggregationParams& params);
  const AggregationParams& params() const { return params_; }

  /// Applies one move to all robots.
  void move(PartialPlan& partial, Vec2 move);
  void follow(PartialPlan& partial, std::span<const Vec2> moves, std::size_t most);
  /// The robots at one position lead to the goal, for at most `steps` steps.
  void lead(PartialPlan& partial, std::size_t place, std::size_t steps, std::size_t most);
  /// Applies a base policy until the robots are gathered; false if that takes too many steps.
  bool finish(PartialPlan& partial, Aggregation method, std::size_t most);
  /// Best continuation within the horizon among the base policies and some random leaders. Returns
  /// its first moves that are worth keeping, at most `commit` unless it gathers all; empty if all
  /// are gathered.
  std::vector<Vec2> look_ahead(const MergedRobots& merged, Rng& rng);

  double way(const Robots& robots, std::size_t i) const;
  double mean_distance(const MergedRobots& merged) const;
  bool gathered(const MergedRobots& merged) const { return mean_distance(merged) < params_.sigma; }
  /// Robot-steps so far.
  double work() const { return work_; }

 private:
  bool pursue(PartialPlan& partial, Aggregation method, std::size_t most, bool to_the_end);
  double left_to_do(MergedRobots merged) const;

  const AggregationMap* map_;
  const RobotStepper* stepper_;
  AggregationParams params_;
  const Routes* routes_;
  double work_ = 0;
};

}  // namespace microswarm
