// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/following/path_follower.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/navigation/hierarchical/impasse.hpp"
#include "microswarm/navigation/hierarchical/local_target.hpp"
#include "microswarm/navigation/hierarchical/predicted_target.hpp"
#include "microswarm/navigation/hierarchical/safety_lookahead.hpp"
#include "microswarm/navigation/prediction/obstacle_predictor.hpp"
#include "microswarm/navigation/safe_interval/safe_interval.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"
#include "microswarm/planning/exact/distance_field.hpp"
#include "microswarm/planning/exact/route.hpp"
#include "microswarm/planning/path/planners.hpp"

namespace microswarm::navigation {

/// Hierarchical D-RRT* navigator; see HierarchicalParams. If it comes no nearer to the goal for
/// some time, a SafeIntervalNavigator leads round what is in the way. States: follow, fallback
/// (pure pursuit instead of the learned follower), hold, escape, arrived, blind, and those of that
/// navigator.
class HierarchicalNavigator : public SteeringNavigator {
 public:
  using Params = HierarchicalParams;
  HierarchicalNavigator(const HierarchicalParams& params, const Task& task, Rng rng);

  void prepare(const Snapshot& world, const Stop& stop) override;
  void overruled(double now, const Command& command) override;
  Diagnostics diagnostics() const override;

 private:
  void update(const Observation& seen, const Stop& stop) override;
  Decision decide(const Moment& moment) override;
  Decision at_goal(const Moment& moment) override;
  Decision without_swarm() override { return {{}, NavigatorState::blind}; }
  Decision finish(const Decision& decision, const Observation& seen) override;
  SafetyLookahead::Start situation(const Snapshot& seen) const {
    return {seen, obstacles_, aim(), pose_, delay()};
  }
  std::optional<Decision> led(const Moment& moment);
  SafeIntervalParams leader_params() const;
  Decision go_on(const Moment& moment);
  double way_left();
  std::optional<Decision> keep_path(const Snapshot& seen);
  bool has_path() const { return path_.size() >= 2; }
  bool path_holds(const Snapshot& world) const;
  void replan(const Snapshot& seen, const Stop& stop, bool may_take_route = true);
  bool is_alone(const Snapshot& seen, std::span<const Vec2> route, PathPosition position) const;
  bool replan_along_route(const Snapshot& seen, double here, const Stop& stop);
  bool replan_with(const Snapshot& world, double clearance, const Stop& stop);
  bool replan_in_time(const Snapshot& seen, double clearance, const Stop& stop);
  void plan_to(const Snapshot& world, Vec2 target, double clearance, const Stop& stop);
  Vec2 towards();
  /// Look-ahead along the route [µm]; within it a visible goal is the target.
  double ahead() const { return 1.5 * params_.target.base_distance; }
  PathFollower::Answer follow(PathPosition& position, const Pose2& pose, double speed) const;
  bool path_is_safe(const Snapshot& seen, double speed,
                    std::optional<double> from_walls = std::nullopt) const;
  std::optional<Decision> keep_route(const Snapshot& seen);
  Decision follow_path(double speed);
  double lookahead_at(double speed) const {
    return lookahead_share_ * params_.lookahead * std::max(0.5, speed / params_.speed);
  }
  /// Remaining path length below which the next path is planned [µm].
  double used_up() const { return std::max(params_.lookahead, 2 * swarm().radius); }
  /// Remaining path length that counts as none [µm].
  double path_end() const { return std::min(1.0, 0.25 * aim().tolerance); }
  bool is_used_up();
  double max_wait(double now);

  /// Shortest paths to the aim among walls.
  struct WallRoute {
    double clearance = 0;  ///< [µm]
    planning::Route route;
  };
  /// Wait for an obstacle to pass.
  struct Wait {
    double since = 0;  ///< [s]
    Vec2 at;
  };

  Task task_;
  HierarchicalParams params_;
  Rng rng_;
  planning::DistanceField route_;
  std::vector<WallRoute> wall_routes_;  ///< by falling clearance
  std::optional<Vec2> via_;  ///< point of the route ahead of the current pose, computed on demand
  SafetyLookahead safety_;
  ObstaclePredictor obstacles_;
  PathFollower follower_;
  Pose2 pose_;  ///< pose at which the command of this step takes effect
  std::vector<Vec2> path_;
  PathPosition position_;
  double path_clearance_ = 0;
  bool path_in_time_ = false;   ///< whether the path was chosen among predicted obstacles
  bool path_is_route_ = false;  ///< whether it is the shortest path to the aim among walls
  double route_clearance_ = 0;  ///< of the path, if it is [µm]
  double lookahead_share_ = 1;
  std::optional<Vec2> target_;
  std::optional<Wait> wait_;  ///< latest wait, until the swarm has left that position
  std::optional<Plan> plan_;
  Impasse impasse_;
  std::unique_ptr<SafeIntervalNavigator> leader_;  ///< from the first impasse on
  bool is_led_ = false;                            ///< whether it decided in this step
};

}  // namespace microswarm::navigation
