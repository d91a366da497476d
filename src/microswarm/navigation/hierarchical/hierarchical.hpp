// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/following/path_follower.hpp"
#include "microswarm/navigation/hierarchical/aim_guide.hpp"
#include "microswarm/navigation/hierarchical/followed_path.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/navigation/hierarchical/impasse_leader.hpp"
#include "microswarm/navigation/hierarchical/local_target.hpp"
#include "microswarm/navigation/hierarchical/predicted_target.hpp"
#include "microswarm/navigation/hierarchical/safety_lookahead.hpp"
#include "microswarm/navigation/prediction/obstacle_predictor.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"
#include "microswarm/planning/path/planners.hpp"

namespace microswarm::navigation {

/// Hierarchical D-RRT* navigator; see HierarchicalParams. If it comes no nearer to the goal for
/// some time, an ImpasseLeader leads round what is in the way. States: follow, fallback (pure
/// pursuit instead of the learned follower), hold, escape, arrived, blind, and the leader's.
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
  Decision advance(const Moment& moment);
  std::optional<Decision> keep_path(const Snapshot& seen);
  bool path_holds(const Snapshot& world) const;
  void replan(const Snapshot& seen, const Stop& stop, bool may_take_route = true);
  bool is_alone(const Snapshot& seen, std::span<const Vec2> route, PathPosition position) const;
  bool replan_along_route(const Snapshot& seen, double here, const Stop& stop);
  bool replan_with(const Snapshot& world, double clearance, const Stop& stop);
  bool replan_in_time(const Snapshot& seen, double clearance, const Stop& stop);
  void plan_to(const Snapshot& world, Vec2 target, double clearance, const Stop& stop);
  PathFollower::Answer follow(PathPosition& position, const Pose2& pose, double speed) const;
  bool path_is_safe(const Snapshot& seen, double speed,
                    std::optional<double> from_walls = std::nullopt) const;
  std::optional<Decision> keep_route(const Snapshot& seen);
  Decision follow_path(double speed);
  double lookahead_at(double speed) const {
    return path_.lookahead_share * params_.lookahead * std::max(0.5, speed / params_.speed);
  }
  /// Remaining path length below which the next path is planned [µm].
  double used_up() const { return std::max(params_.lookahead, 2 * swarm().radius); }
  /// Remaining path length that counts as none [µm].
  double path_end() const { return std::min(1.0, 0.25 * aim().tolerance); }
  bool is_used_up();
  double max_wait(double now);

  /// Wait for an obstacle to pass.
  struct Wait {
    double since = 0;  ///< [s]
    Vec2 at;
  };

  HierarchicalParams params_;
  Rng rng_;
  AimGuide guide_;
  SafetyLookahead safety_;
  ObstaclePredictor obstacles_;
  PathFollower follower_;
  Pose2 pose_;  ///< pose at which the command of this step takes effect
  FollowedPath path_;
  std::optional<Vec2> target_;
  std::optional<Wait> wait_;  ///< latest wait, until the swarm has left that position
  std::optional<Plan> plan_;
  ImpasseLeader leader_;
};

}  // namespace microswarm::navigation
