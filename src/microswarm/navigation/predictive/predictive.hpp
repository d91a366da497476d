// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/navigation/prediction/convex_outline.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"
#include "microswarm/navigation/predictive/predictive_params.hpp"
#include "microswarm/navigation/predictive/time_field.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"
#include "microswarm/planning/exact/distance_field.hpp"

namespace microswarm {

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
  static constexpr int leg_pieces = 5;
  struct Leg {
    Command command;
    double cost = 0;
    double min_gap = 0;  ///< to obstacles [µm]
  };

  struct Meeting {
    double gap = std::numeric_limits<double>::infinity();  ///< minimum, if near [µm]
    double risk = 0;                                       ///< maximum, cost per second
  };

  void update(const Observation& seen, const Stop& stop) override;
  Decision decide(const Moment& moment) override;
  Decision finish(const Decision& decision, const Observation& seen) override;
  void look_at_bodies(const Observation& seen, Vec2 from);
  bool stands_hollow(const ConvexOutline& outline, const TrackedBody& motion, Vec2 from) const;
  void look_ahead(double effect);
  bool goal_is_clear(const Map& map, const Pose2& pose) const;
  void solve(const Map& map, Vec2 from);
  double left_from(Vec2 p);
  float standing_risk(const Map& map, Vec2 p) const;
  Leg best_leg(const Map& map, const Pose2& pose);
  Leg tried(const Map& map, const Pose2& pose, const Command& command, double bound);
  std::optional<double> best_heading(Vec2 p) const;
  double turning_time(const Pose2& pose) const;
  Meeting meeting(int piece, Segment move) const;
  double follow_field(Vec2 from);

  PredictiveParams params_;
  Disc reached_;            ///< region that counts as the goal reached
  double ends_within_ = 0;  ///< distance from the goal at which the final approach ends [µm]
  double radius_;           ///< including the gap [µm]
  MultiModelPredictor predictor_;
  TimeField field_;
  DistanceField route_;
  bool in_sight_ = true;          ///< is the goal?
  std::optional<double> wanted_;  ///< heading to turn to, of a swarm that turns slowly [rad]
  bool ending_ = false;           ///< is it at the last bit, finer than the field's cells?

  ConvexOutliner outliner_;
  std::vector<ConvexOutline> outlines_;  ///< of the predicted bodies
  std::vector<std::size_t> body_of_;
  std::size_t bodies_ = 0;
  double effect_ = 0;                     ///< time at which the command takes effect [s]
  std::vector<PredictedBody> ahead_;      ///< at the samples of the field
  std::vector<PredictedBody> leg_ahead_;  ///< at the ends of the segments of the first leg
  std::vector<Body> nonconvex_bodies_;
  BodySet nonconvex_;   ///< bodies whose hull contains the swarm, in their present shape
  double closing_ = 0;  ///< upper bound of their approach in the meantime [µm]
  std::vector<Vec2> path_;
};

}  // namespace microswarm
