// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/baselines/potential_field_params.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/navigation/steering/guide.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"

namespace microswarm::navigation {

/// Potential field baseline; see PotentialFieldParams. Commands never lead into a wall: if the
/// force does, the nearest direction that does not is taken. States: follow (no repulsion), avoid,
/// stuck (the forces cancel: a local minimum), hold, arrived, blind.
class PotentialFieldNavigator : public SteeringNavigator {
 public:
  using Params = PotentialFieldParams;
  PotentialFieldNavigator(const PotentialFieldParams& params, const Task& task, Rng);

  void prepare(const Snapshot& world, const Stop& stop) override;

 private:
  void update(const Observation& seen, const Stop& stop) override;
  Decision decide(const Moment& moment) override;
  double push(double gap, double influence) const;
  Vec2 push_of_walls(const Map& map, Vec2 p) const;
  Vec2 repulsive_push(const Body& body, const TrackedBody& motion, Vec2 p, Vec2 wanted) const;
  double calm_near_goal(Vec2 p) const;
  std::optional<Command> clear_of_walls(const Map& map, const Pose2& pose, Vec2 force) const;

  PotentialFieldParams params_;
  GoalGuide guide_;
  ObstacleTracker tracker_;
};

}  // namespace microswarm::navigation
