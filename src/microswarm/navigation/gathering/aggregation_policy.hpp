// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/rng.hpp"
#include "microswarm/core/status.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/navigation/gathering/divide_and_conquer.hpp"
#include "microswarm/navigation/gathering/merged_robots.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"

namespace microswarm {

/// Gathers robots at the goal with one input for all: Alg 3 and 5 [gather]. Both may be caught in a
/// livelock (robots that are handed to and fro). A guard watches the mean way to the goal: when it
/// has not become shorter for some of the map's longest ways, from then on robots chosen at random
/// lead to the goal, so that no sequence of moves repeats for ever. `gather` has a limit of steps.
class AggregationPolicy {
 public:
  /// The map must outlive it. The method `rollout` is taken as divide_and_conquer.
  AggregationPolicy(const AggregationMap& map, const AggregationParams& params);

  /// The next move [µm] of all robots; nothing when they are gathered: F < σ. Where `counts` are
  /// given, so many robots are in each place. Looks only at those that moved since the last call.
  std::optional<Vec2> next(const Robots& robots, std::span<const std::uint32_t> counts = {});
  /// Tells that places were joined: the new place of each old one (see MergedRobots::join).
  void remap(std::span<const std::uint32_t> new_places);

  /// F(n, t): mean way to the goal [µm] of the robots last seen.
  double mean_distance() const { return mean_distance_; }
  /// The robot that leads.
  std::size_t leader() const { return leader_; }
  /// Where it is led to.
  Vec2 waypoint() const { return waypoint_; }
  /// 1 when the guard had to break a livelock.
  int guard_count() const { return breaks_; }

 private:
  void look(const Robots& robots, std::span<const std::uint32_t> counts);
  std::size_t farthest() const;
  std::size_t to_the_goal(bool any);
  std::size_t some();
  bool guard();
  Vec2 waypoint_of(std::size_t robot, Vec2 p);

  const AggregationMap* map_;
  AggregationParams params_;
  const Routes* routes_;
  DivideAndConquer dca_;
  Rng rng_{1, Purpose::planner};
  double longest_ = 0;         ///< way [µm] from any node
  std::vector<float> seen_x_;  ///< where each robot was seen last
  std::vector<float> seen_y_;
  RobotsOnMap seen_;
  std::vector<std::uint32_t> heading_for_;  ///< node that each robot was last led to
  double sum_distances_ = 0;                ///< over all robots
  double robots_ = 0;                       ///< how many
  double mean_distance_ = 0;
  std::size_t leader_ = ~std::size_t{0};
  Vec2 waypoint_;
  std::size_t last_leader_ = ~std::size_t{0};
  Vec2 last_place_;
  int held_ = 0;  ///< steps for which the leader has not moved
  double best_mean_ = 0;
  int since_best_ = 0;
  double patience_ = 0;
  bool breaks_ = false;  ///< a livelock: any robot leads
};

}  // namespace microswarm
