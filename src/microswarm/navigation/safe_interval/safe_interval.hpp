// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"
#include "microswarm/navigation/safe_interval/imminent_check.hpp"
#include "microswarm/navigation/safe_interval/kept_plan.hpp"
#include "microswarm/navigation/safe_interval/obstacle_forecast.hpp"
#include "microswarm/navigation/safe_interval/safe_interval_params.hpp"
#include "microswarm/navigation/safe_interval/space_time_planner.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"
#include "microswarm/planning/exact/route.hpp"

namespace microswarm::navigation {

/// Reports bounds of the prediction that do not ascend.
Issues validate(const SafeIntervalParams& params);

/// Safe-interval navigator; see SafeIntervalParams. States: follow, avoid (an obstacle is near, or
/// the command was replaced), wait (as planned, for an obstacle to pass), escape (no command is
/// safe, and none continues a safe manoeuvre), hold, arrived, blind.
class SafeIntervalNavigator : public SteeringNavigator {
 public:
  using Params = SafeIntervalParams;
  SafeIntervalNavigator(const SafeIntervalParams& params, const Task& task, Rng);

  void prepare(const Snapshot& world, const Stop& stop) override;
  Diagnostics diagnostics() const override;

 private:
  void update(const Observation& seen, const Stop& stop) override;
  Decision decide(const Moment& moment) override;
  Decision finish(const Decision& decision, const Observation& seen) override;

  void review(const Moment& moment, double now);
  bool goes_straight(const Moment& moment, double now);
  bool takes(const Pose2& pose, std::span<const Vec2> points, double now);
  void replan(const Moment& moment, double now, double conflict);
  bool takes_route(const Moment& moment, double now);
  void shorten(const Moment& moment, double now);
  double entry_clearance(const Map& map, Vec2 p) const;
  Command wanted(const Moment& moment, double now);
  Command steady(const Command& command) const;
  double approach_speed(const Pose2& pose, Vec2 target, bool is_goal) const;

  SafeIntervalParams params_;
  double tick_;
  double straying_ = 0;  ///< distance that the swarm may be from its estimate [µm]
  double radius_;        ///< with it [µm]
  MultiModelPredictor predictor_;
  ObstacleForecast forecast_;
  planning::TurnFirst turning_;
  SpaceTimePlanner planner_;
  std::vector<planning::Route> routes_;  ///< to the goal among walls, by falling clearance
  KeptPlan plan_;
  KeptPlan tried_;  ///< another plan that is tested
  ImminentCheck imminent_;
  std::optional<double> reviewed_;  ///< time of the last search [s]
  Command last_;                    ///< last command
  std::vector<Vec2> path_;
};

}  // namespace microswarm::navigation
