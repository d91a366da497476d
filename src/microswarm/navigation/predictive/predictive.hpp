// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"
#include "microswarm/navigation/predictive/obstacle_horizon.hpp"
#include "microswarm/navigation/predictive/predictive_params.hpp"
#include "microswarm/navigation/predictive/time_field.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"
#include "microswarm/planning/exact/distance_field.hpp"

namespace microswarm::navigation {

/// Reports an empty list of speeds, and bounds of the prediction that do not ascend.
Issues validate(const PredictiveParams& params);

/// Predictive navigator; see PredictiveParams. States: follow (no obstacle predicted near the
/// path), avoid, escape (contact predicted even on the best path), hold, arrived, blind.
class PredictiveNavigator : public SteeringNavigator {
 public:
  using Params = PredictiveParams;
  PredictiveNavigator(const PredictiveParams& params, const Task& task, Rng);

  void prepare(const Snapshot& world, const Stop& stop) override;
  Diagnostics diagnostics() const override;

  const MultiModelPredictor& prediction() const { return predictor_; }

 private:
  struct Leg {
    Command command;
    double cost = 0;
    double min_gap = 0;  ///< to obstacles [µm]
  };

  void update(const Observation& seen, const Stop& stop) override;
  Decision decide(const Moment& moment) override;
  Decision finish(const Decision& decision, const Observation& seen) override;
  bool goal_is_clear(const Map& map, const Pose2& pose) const;
  void solve(const Map& map, Vec2 from);
  double left_from(Vec2 p);
  float standing_risk(const Map& map, Vec2 p) const;
  Leg best_leg(const Map& map, const Pose2& pose);
  Leg tried(const Map& map, const Pose2& pose, const Command& command, double bound);
  std::optional<double> best_heading(Vec2 p) const;
  double turning_time(const Pose2& pose) const;
  double follow_field(Vec2 from);

  PredictiveParams params_;
  Disc reached_;            ///< region that counts as the goal reached
  double ends_within_ = 0;  ///< distance from the goal at which the final approach ends [µm]
  double radius_;           ///< including the gap [µm]
  MultiModelPredictor predictor_;
  TimeField field_;
  planning::DistanceField route_;
  bool in_sight_ = true;          ///< is the goal?
  std::optional<double> wanted_;  ///< heading to turn to, of a swarm that turns slowly [rad]
  bool ending_ = false;           ///< is it at the last bit, finer than the field's cells?

  ObstacleHorizon horizon_;
  std::vector<Vec2> path_;
};

}  // namespace microswarm::navigation
