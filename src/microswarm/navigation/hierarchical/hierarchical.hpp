// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/infinity.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/navigation/following/path_follower.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/navigation/hierarchical/local_target.hpp"
#include "microswarm/navigation/hierarchical/predicted_target.hpp"
#include "microswarm/navigation/prediction/obstacle_predictor.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/navigation/steering/delay_compensator.hpp"
#include "microswarm/navigation/steering/guide.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"

namespace microswarm {

/// See HierarchicalParams. States: follow, fallback (the learned follower does not know and hands
/// over to pure pursuit), hold, escape, arrived, blind.
class HierarchicalNavigator : public Navigator {
 public:
  /// `swarm` is what is known of the swarm: radius, turning limit and dead time.
  HierarchicalNavigator(const HierarchicalParams& params, const SwarmLimits& swarm, Vec2 goal,
                        double goal_tolerance, Rng rng,
                        double frame_timeout = default_frame_timeout);

  void prepare(const Snapshot& world) override;
  Command step(const Observation& observation, const Stop& stop) override;
  NavigatorView view() const override { return view_; }

 private:
  struct Rollout {
    bool safe = false;
    double least = 0;  ///< least clearance on the way [µm]
    double last = 0;   ///< clearance at its end [µm]
  };

  Command decide(const Observation& seen, const Stop& stop);
  Command issue(double now, Command command, NavigatorState state);
  bool path_holds(const Snapshot& world) const;
  void replan(const Snapshot& seen, const Stop& stop);
  bool replan_with(const Snapshot& world, double clearance, const Stop& stop);
  bool replan_in_time(const Snapshot& seen, double clearance, const Stop& stop);
  void plan_to(const Snapshot& world, Vec2 target, double clearance, const Stop& stop);
  Vec2 towards(const Map& map) const;
  /// Plays `steer(pose, seconds) → command` through for the horizon; ends early, unsafe, once the
  /// clearance falls below `floor`.
  template <class Steer>
  Rollout look_ahead(const Observation& seen, double floor, Steer&& steer) const;
  double wall_floor(const Map& map, double reach) const;
  double far_enough() const { return 2 * params_.clearance + params_.extra_clearance; }
  PathFollower::Answer follow(PathPlace& place, const Pose2& pose, double speed) const;
  Rollout look_along_path(const Observation& seen, double speed) const;
  double lookahead_at(double speed) const {
    return params_.lookahead * std::max(0.5, speed / params_.speed);
  }
  /// So little of a path is left when the next one is planned [µm].
  double used_up() const { return std::max(params_.lookahead, 2 * swarm_.radius); }
  /// So little that it counts as nothing [µm].
  double path_end() const { return std::min(1.0, 0.25 * aim_.tolerance); }
  bool is_used_up();
  double max_wait(double now);
  Command escape(const Observation& seen);

  /// A wait for an obstacle to pass.
  struct Wait {
    double since = 0;  ///< [s]
    Vec2 at;
  };

  HierarchicalParams params_;
  SwarmLimits swarm_;
  Vec2 goal_;
  double goal_tolerance_;
  double frame_timeout_;  ///< [s]
  Aim aim_;               ///< the goal, or the point within its tolerance that keeps the margin
  Rng rng_;
  Route route_;
  double slack_ = 1;     ///< kept besides the margin, for what happens within a tick [µm]
  double period_ = 0.1;  ///< between the last two commands [s]
  double delay_ = 0;     ///< from the frame until the command of this step takes effect [s]

  std::optional<double> issued_at_;  ///< the last command [s]
  DelayCompensator compensator_;
  ObstaclePredictor obstacles_;
  PathFollower follower_;
  Pose2 pose_;  ///< where the swarm will be when the command of this step takes effect
  std::vector<Vec2> path_;
  PathPlace place_;
  double path_clearance_ = 0;
  bool path_in_time_ = false;  ///< was the path chosen among predicted obstacles?
  std::optional<Vec2> target_;
  std::optional<Wait> wait_;  ///< the newest, until the swarm has left that place
  std::optional<Plan> plan_;
  NavigatorView view_;
};

}  // namespace microswarm
