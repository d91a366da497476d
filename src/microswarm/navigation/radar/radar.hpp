// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/radar/radar_circles.hpp"
#include "microswarm/navigation/radar/radar_route.hpp"
#include "microswarm/navigation/radar/radar_scan.hpp"
#include "microswarm/navigation/radar/radar_scanner.hpp"
#include "microswarm/navigation/radar/safety_filter.hpp"
#include "microswarm/navigation/radar/safety_radius.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"

namespace microswarm::navigation {

/// Reports inconsistent parameters, a step that is too long for the swarm, and waypoints that it
/// cannot occupy.
Issues validate(const RadarParams& params, const SwarmLimits& swarm, const Map& map,
                const IsGiven& is_given);

/// Navigator with a hierarchical radar [radar]; see RadarParams. It knows only the positions and
/// sizes of obstacles. For holonomic swarms. States: direct, avoid,
/// retreat, guard (the safety filter's command), hold, wait, arrived, blind, and stuck if there is
/// no plan around the walls or they block all directions that lead nearer.
class RadarNavigator : public SteeringNavigator {
 public:
  using Params = RadarParams;
  /// `params` must have passed `validate`.
  RadarNavigator(const RadarParams& params, const Task& task, Rng rng);

  void prepare(const Snapshot& world, const Stop& stop) override;
  Diagnostics diagnostics() const override;

  /// Input of the last decision by Eq 9–17, for `scan`; empty if the last step made none: blind, or
  /// inside a body.
  const std::optional<RadarLook>& last_look() const { return look_; }
  /// Number of candidate directions.
  int directions() const { return direction_count(params_); }

 private:
  /// Last observed swarm.
  struct Sighting {
    double time = 0;  ///< [s]
    SwarmPose swarm;
  };

  void update(const Observation& seen, const Stop& stop) override;
  bool sees_swarm(const Observation& seen) const override;
  Decision decide(const Moment& moment) override;
  Decision at_goal(const Moment& moment) override { return decide(moment); }
  Decision without_swarm() override { return {{}, NavigatorState::blind}; }
  Decision finish(const Decision& decision, const Observation& seen) override;
  Decision filtered(const Decision& decision, const Observation& seen);
  void find_route(const Observation& seen, const Stop& stop);
  Pose2 beside_walls(const Map& map, double radius) const;
  bool plan_route(const Snapshot& walls, Pose2 from, double clearance, const Stop& stop);
  void look_around(const Observation& seen, Vec2 target);
  std::optional<Decision> retreat(const Observation& seen);
  Decision rest(const Observation& seen, NavigatorState state);

  RadarParams params_;
  Rng rng_;
  SafetyRadius safety_radius_;
  RadarScanner scanner_;
  SafetyFilter filter_;
  RadarRoute route_;
  std::optional<Plan> plan_;          ///< latest plan, of any status
  bool routed_ = false;               ///< whether a route was searched
  double plan_again_at_ = 0;          ///< [s]
  double wait_ = 0;                   ///< time between two plans; longer after each failure [s]
  std::optional<Sighting> sighting_;  ///< for the safety filter
  std::optional<Vec2> course_;        ///< last commanded direction
  Pose2 pose_;                        ///< pose at which the command takes effect
  std::optional<RadarLook> look_;
  std::shared_ptr<const Snapshot> seen_;  ///< world of the look
  std::optional<RadarContact> contact_;
};

}  // namespace microswarm::navigation
