// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "microswarm/core/fields.hpp"
#include "microswarm/navigation/guide.hpp"
#include "microswarm/navigation/helm.hpp"
#include "microswarm/navigation/obstacle_tracker.hpp"

namespace microswarm {

/// Baseline: velocity obstacles (Fiorini and Shiller, IJRR 17, 1998), not reciprocal: of the
/// velocities on a grid of directions and speeds that meet nothing within the horizon, the one
/// nearest to the preferred one, which is at full speed to the target.
struct VelocityObstacleParams {
  static constexpr std::string_view type_name = "velocity_obstacle";
  double speed = 60;
  int directions = 72;
  int speeds = 4;
  double horizon = 4;
  double wall_horizon = 1;
  double margin = 10;
  double urgency = 200;
  Guide guide = Guide::route;
  double frame_timeout = 0.5;
  ObstacleTrackerParams tracker;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.speed, {"speed", Unit::um_per_s, {1e-3, 1e5}, "Speed asked for."});
    visit(self.directions, {"directions", Unit::none, {3, 3600}, "Directions to choose from."});
    visit(self.speeds, {"speeds", Unit::none, {1, 100}, "Speeds to choose from, besides 0."});
    visit(self.horizon,
          {"horizon", Unit::s, {0, 60}, "Velocities that meet no obstacle for so long will do."});
    visit(self.wall_horizon,
          {"wall_horizon", Unit::s, {0, 60}, "Velocities that meet no wall for so long will do."});
    visit(self.margin, {"margin", Unit::um, {0, 1e5}, "Kept beside the swarm's edge."});
    visit(self.urgency,
          {"urgency",
           Unit::um,
           {0, 1e6},
           "Where no velocity will do: the least of urgency / time to contact + distance to the "
           "preferred velocity is taken."});
    visit(self.guide, {"guide", Unit::none, {}, "Direction of the goal: straight, or route."});
    visit(self.frame_timeout,
          {"frame_timeout", Unit::s, {0, 60}, "Hold when the newest frame is older than this."});
    visit(self.tracker, {"tracker", Unit::none, {}, "How the obstacles' motion is told."});
  }
};

/// See VelocityObstacleParams. States: follow (the preferred velocity), avoid, escape (none will
/// do), hold, arrived, blind.
class VelocityObstacleNavigator : public Navigator {
 public:
  VelocityObstacleNavigator(const VelocityObstacleParams& params, const SwarmLimits& swarm,
                            Vec2 goal, double goal_tolerance);

  void prepare(const Snapshot& world) override;
  Command step(const Observation& observation, const Stop& stop) override;
  NavigatorView view() const override { return helm_.view(); }

 private:
  /// A body that may be met.
  struct Threat {
    const Body* body = nullptr;
    Vec2 velocity;
    double reach = 0;   ///< so near to it counts as contact [µm]
    double growth = 0;  ///< of a disc's reach [µm/s]
  };
  struct Choice {
    double turn = 0;  ///< from the preferred heading [rad]
    double speed = 0;
    double off = 0;  ///< from the preferred velocity [µm/s]
  };

  void rank_choices();
  void find_threats(const Snapshot& world, Vec2 p);
  bool clear_of_walls(const Map& map, const Pose2& pose, const Command& command) const;
  double time_to_contact(const Pose2& pose, const Command& command) const;
  double time_to_contact(const Threat& threat, Segment way, double t0, double t1) const;

  VelocityObstacleParams params_;
  Helm helm_;
  GoalGuide guide_;
  ObstacleTracker tracker_;
  std::vector<Threat> threats_;
  std::vector<Choice> choices_;  ///< nearest to the preferred one first
};

}  // namespace microswarm
