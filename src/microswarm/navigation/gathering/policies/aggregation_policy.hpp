// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/gathering/policies/divide_and_conquer.hpp"
#include "microswarm/navigation/gathering/policies/dynamic_shortest_path.hpp"
#include "microswarm/navigation/gathering/policies/leaders.hpp"
#include "microswarm/navigation/gathering/policies/merged_robots.hpp"
#include "microswarm/navigation/gathering/policies/responding_robots.hpp"
#include "microswarm/navigation/gathering/policies/swarm_distances.hpp"
#include "microswarm/navigation/gathering/policies/waypoint_follower.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm::navigation {

/// Gathers robots at the goal with one input for all: Alg 3 and 5 [gather] and dynamic shortest
/// path. Each step chooses a leader and leads it towards the goal, or to another robot. A robot
/// that does not follow its lead is set aside (RespondingRobots). All algorithms may enter a
/// livelock, in which robots move to and fro: from then on random robots lead (LivelockGuard), so
/// that no sequence of moves repeats without end. `gather` limits the steps.
class AggregationPolicy {
 public:
  static constexpr std::size_t no_leader = RespondingRobots::nobody;

  /// The map must outlive it. The method `rollout` is taken as divide_and_conquer.
  AggregationPolicy(const AggregationMap& map, const AggregationParams& params);

  /// The next move [µm] of all robots; nothing when they are gathered: F < σ. `counts`, where
  /// given, is the number of robots at each position. Looks only at those that moved since the last
  /// call.
  std::optional<Vec2> next(const Robots& robots, std::span<const std::uint32_t> counts = {});
  /// Takes the merging of positions: the new index of each old one (see
  /// MergedRobots::merge_coincident).
  void remap(std::span<const std::uint32_t> new_positions);

  /// F(n, t): mean path length to the goal [µm] of the robots last seen.
  double mean_distance() const { return left(Gathered::mean); }
  /// The distance [µm] that must fall below σ.
  double distance_left() const { return left(params_.gathered); }
  /// The robot that leads; `no_leader` before the first move.
  std::size_t leader() const { return responding_.original(leader_); }
  /// Robots that do not follow the input and no longer lead.
  std::span<const std::size_t> set_aside() const { return responding_.aside(); }
  /// State of Alg 5 [gather].
  const DivideAndConquer& division() const { return dca_; }
  /// The point it is led to.
  Vec2 waypoint() const { return chases_ ? chase_->waypoint() : follower_.waypoint(); }
  /// 1 when the guard had to break a livelock.
  int guard_count() const { return is_livelock() ? 1 : 0; }

 private:
  double left(Gathered measure) const;
  Vec2 lead(std::size_t robot, Vec2 move);
  void restart(const Robots& all, std::span<const std::uint32_t> counts);
  bool is_livelock() const { return guard_.is_livelock() || (chase_ && chase_->gave_up()); }

  const AggregationMap* map_;
  AggregationParams params_;
  RespondingRobots responding_;
  SwarmDistances distances_;  ///< of those that respond
  DivideAndConquer dca_;
  LivelockGuard guard_;
  WaypointFollower follower_;
  std::optional<DynamicShortestPath> chase_;
  bool chases_ = false;
  double aside_count_ = 0;  ///< of robots that were set aside
  double aside_sum_ = 0;    ///< of their path lengths [µm]
  double aside_max_ = 0;
  Rng rng_{1, Purpose::planner};
  std::size_t leader_ = no_leader;
};

}  // namespace microswarm::navigation
