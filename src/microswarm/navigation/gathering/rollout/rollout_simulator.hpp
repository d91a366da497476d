// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/navigation/gathering/policies/aggregation_policy.hpp"
#include "microswarm/navigation/gathering/policies/common_input.hpp"
#include "microswarm/planning/gathering/obstacle_weighted_rrt.hpp"

namespace microswarm::navigation {

/// All moves up to the end, with the merged robots before every 16th move.
struct RolloutPlan {
  static constexpr std::size_t checkpoint_interval = 16;
  std::vector<Vec2> moves{};
  std::vector<MergedRobots> checkpoints{};
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

/// Simulates continuations of a plan and counts the work; several threads may do so at once. `most`
/// is the maximum number of steps of the partial plan.
class RolloutSimulator {
 public:
  /// The map must outlive it.
  RolloutSimulator(const AggregationMap& map, const CommonInput& input,
                   const AggregationParams& params);
  const AggregationParams& params() const { return params_; }

  /// Calls `trial(i)` for each i in 0 … count−1 on `threads` threads.
  void try_each(std::size_t count, const std::function<void(std::size_t)>& trial);

  /// Applies these moves to all robots.
  void follow(PartialPlan& partial, std::span<const Vec2> moves, std::size_t most);
  /// The same, but ends as soon as all are gathered.
  void follow_until_gathered(PartialPlan& partial, std::span<const Vec2> moves, std::size_t most);
  /// The robots at one position lead to the goal, for at most `steps` steps.
  void lead(PartialPlan& partial, std::size_t position, std::size_t steps, std::size_t most);
  /// Progress of a policy.
  enum class Pursuit { gathered, paused, too_long };
  /// Applies a policy until the robots are gathered, until that takes too many steps, or until
  /// `pause` steps, a multiple of checkpoint_interval.
  Pursuit pursue(PartialPlan& partial, AggregationPolicy& policy, std::size_t most,
                 std::size_t pause);
  /// Applies a base policy until the robots are gathered; false if that takes too many steps.
  bool finish(PartialPlan& partial, Aggregation method, std::size_t most);
  /// Some random moves: one robot leads to the goal, at `first` the farthest one, or all go in one
  /// direction. Ends when all are gathered. Keeps checkpoints.
  void try_moves(PartialPlan& partial, bool first, std::size_t most, Rng& rng);
  /// Representatives of the robots, as weighted robots.
  MergedRobots representatives(const MergedRobots& merged) const;

  /// The base policy.
  AggregationPolicy policy(Aggregation method) const;

  /// F: mean path length to the goal [µm].
  double mean_distance(const MergedRobots& merged) const;
  /// The distance [µm] that must fall below σ.
  double distance_left(const MergedRobots& merged) const;
  bool gathered(const MergedRobots& merged) const { return distance_left(merged) < params_.sigma; }
  /// Estimate of the remaining work [robot-steps], to compare states after equally many steps.
  double left_to_do(MergedRobots merged) const;
  /// Work so far [robot-steps].
  double work() const { return static_cast<double>(work_.load()); }

 private:
  class Work;
  void move(PartialPlan& partial, Vec2 move, Work& work) const;
  double remaining(const Robots& robots, std::size_t i) const;
  double power(std::uint32_t count) const;
  std::size_t farthest(const Robots& robots) const;

  const AggregationMap* map_;
  CommonInput input_;
  AggregationParams params_;
  ThreadTeam threads_;
  std::atomic<std::uint64_t> work_ = 0;  ///< added to by threads
  std::vector<double> powers_;           ///< of the number of robots at a place
};

}  // namespace microswarm::navigation
