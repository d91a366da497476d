// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/baselines/velocity_obstacle_params.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/steering/guide.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"

namespace microswarm::navigation {

/// Velocity-obstacle baseline; see VelocityObstacleParams. States: follow (the preferred velocity),
/// avoid, escape (no velocity is collision-free), hold, arrived, blind.
class VelocityObstacleNavigator : public SteeringNavigator {
 public:
  using Params = VelocityObstacleParams;
  VelocityObstacleNavigator(const VelocityObstacleParams& params, const Task& task, Rng);

  void prepare(const Snapshot& world, const Stop& stop) override;

 private:
  /// Body that may be met.
  struct Threat {
    const Body* body = nullptr;
    Vec2 velocity;
    double reach = 0;   ///< distance that counts as contact [µm]
    double growth = 0;  ///< rate of a disc's reach [µm/s]
  };
  struct Choice {
    double turn = 0;  ///< from the preferred heading [rad]
    double speed = 0;
    double off = 0;  ///< distance from the preferred velocity [µm/s]
  };

  void update(const Observation& seen, const Stop& stop) override;
  Decision decide(const Moment& moment) override;
  void rank_choices();
  void find_threats(const Snapshot& world, Vec2 p);
  bool clear_of_walls(const Map& map, const Pose2& pose, const Command& command) const;
  double time_to_contact(const Pose2& pose, const Command& command) const;
  double time_to_contact(const Threat& threat, Segment leg, double t0, double t1) const;

  VelocityObstacleParams params_;
  GoalGuide guide_;
  ObstacleTracker tracker_;
  std::vector<Threat> threats_;
  std::vector<Choice> choices_;  ///< nearest to the preferred velocity first
};

}  // namespace microswarm::navigation
