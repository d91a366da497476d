// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/infinity.hpp"
#include "microswarm/core/rng.hpp"
#include "microswarm/navigation/radar/guard.hpp"
#include "microswarm/navigation/radar/radar_circles.hpp"
#include "microswarm/navigation/radar/radar_route.hpp"
#include "microswarm/navigation/radar/radar_scan.hpp"
#include "microswarm/navigation/radar/radar_scanner.hpp"
#include "microswarm/navigation/radar/safety_radius.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/navigation/steering/body_forecast.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"

namespace microswarm {

/// Navigation by a hierarchical radar [radar], see RadarParams. It knows of obstacles only where
/// they are and how wide. Made for a swarm that moves into any direction at once. States: direct,
/// avoid, retreat, guard (it does what the guard orders instead), hold, wait, arrived, blind, and
/// stuck when there is no plan round the walls or they leave no way that leads nearer.
class RadarNavigator : public Navigator {
 public:
  /// `params` passed `check`; `swarm` is what is known of the swarm.
  RadarNavigator(const RadarParams& params, const SwarmLimits& swarm, Vec2 goal,
                 double goal_tolerance, Rng rng, double frame_timeout = default_frame_timeout);

  void prepare(const Snapshot& world) override;
  Command step(const Observation& observation, const Stop& stop) override;
  NavigatorView view() const override { return view_; }

  /// What the last decision by Eq 9–17 rests on, for `scan`; empty when the last step looked at
  /// nothing: blind, or inside a body.
  const std::optional<RadarLook>& last_look() const { return look_; }
  /// How many it chooses from.
  int directions() const { return directions_of(params_); }

 private:
  Command decide(const Observation& seen, const Stop& stop);
  Command guarded(const Command& command, const Observation& seen);
  void find_route(const Observation& seen, const Stop& stop);
  Pose2 beside_walls(const Map& map, double radius) const;
  bool plan_route(const Snapshot& walls, Pose2 from, double clearance, const Stop& stop);
  RadarLook look_around(const Observation& seen, Vec2 target) const;
  Command rest(const Observation& seen, NavigatorState state);
  Command issue(const Command& command, NavigatorState state);

  RadarParams params_;
  SwarmLimits swarm_;
  Vec2 goal_;
  Aim aim_;  ///< the goal, or the point within its tolerance that keeps the safety distance
  double goal_tolerance_;
  double frame_timeout_;  ///< [s]
  Rng rng_;
  SafetyRadius safety_radius_;
  BodyForecast forecast_;
  RadarScanner scanner_;
  Guard guard_;
  RadarRoute route_;
  std::optional<Plan> plan_;    ///< the newest one, found or not
  bool routed_ = false;         ///< has looked for a route
  double plan_again_at_ = 0;    ///< [s]
  double wait_ = 0;             ///< from the last plan to the next, longer after each failure [s]
  std::optional<double> last_;  ///< when a step was asked for last [s]
  double sighted_ = 0;          ///< when the swarm was seen last [s]
  std::optional<SwarmPose> sighting_;
  std::optional<Vec2> course_;  ///< the direction last driven
  Pose2 pose_;                  ///< where the swarm is when the command takes effect
  std::optional<RadarLook> look_;
  std::optional<RadarContact> contact_;
  NavigatorView view_;
};

}  // namespace microswarm
