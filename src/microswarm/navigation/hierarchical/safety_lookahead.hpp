// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "microswarm/contracts/command.hpp"
#include "microswarm/navigation/hierarchical/hierarchical_params.hpp"
#include "microswarm/navigation/prediction/obstacle_predictor.hpp"
#include "microswarm/navigation/steering/aim.hpp"
#include "microswarm/swarm/body/swarm_limits.hpp"

namespace microswarm::navigation {

/// Look-ahead of HierarchicalNavigator (ours, not in [drrt]): simulates the swarm for the horizon
/// among predicted obstacles, and measures its clearance.
class SafetyLookahead {
 public:
  /// Situation from which it looks ahead.
  struct Start {
    const Snapshot& world;  ///< as observed
    const ObstaclePredictor& obstacles;
    const Aim& aim;
    Pose2 pose{};      ///< when the command takes effect
    double delay = 0;  ///< from the frame until then [s]
  };
  /// Command at a pose, which is reached after that time [s].
  using Steering = std::function<Command(const Pose2&, double)>;

  /// `params` must be in effect, with a speed that the swarm reaches.
  SafetyLookahead(const HierarchicalParams& params, const SwarmLimits& swarm);

  /// Time from one command to the next [s].
  double period() const { return period_; }
  void set_period(double seconds) { period_ = seconds; }

  /// Whether the swarm keeps the clearance when steered like this; from walls `from_walls` [µm], if
  /// given.
  bool is_safe(const Start& start, const Steering& steer,
               std::optional<double> from_walls = std::nullopt) const;
  /// First command of the best escape: of the hold and the manoeuvres of one leg, or two if one is
  /// not enough, the one with the largest clearance.
  Command escape(const Start& start) const;

 private:
  struct Rollout {
    double least = 0;  ///< minimum clearance along it [µm]
    double last = 0;   ///< clearance at its end [µm]
  };

  template <class Visit>
  void roll_out(const Start& start, const Steering& steer, Visit&& visit) const;
  Rollout look_ahead(const Start& start, double floor, const Steering& steer) const;
  double from_obstacles(const Start& start, Segment move, double from, double enough) const;
  double wall_floor(const Start& start, double reach) const;
  double far_enough() const { return 2 * params_.clearance + params_.extra_clearance; }

  HierarchicalParams params_;
  double radius_;         ///< of the swarm [µm]
  double max_turn_rate_;  ///< [rad/s]
  double slack_ = 1;      ///< kept besides the clearance, for what happens within a tick [µm]
  double period_ = 0.1;
};

}  // namespace microswarm::navigation
