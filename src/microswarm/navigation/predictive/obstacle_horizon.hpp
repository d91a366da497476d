// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/prediction/convex_outline.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"
#include "microswarm/navigation/predictive/predictive_params.hpp"
#include "microswarm/navigation/predictive/time_field.hpp"

namespace microswarm::navigation {

/// Moving bodies over the horizon of a step: the convex outlines of the predicted ones, and those
/// that are taken as they are now. Allocates only if there are more bodies than ever before.
class ObstacleHorizon {
 public:
  static constexpr int leg_pieces = 5;  ///< segments of the first leg

  /// Minimum gap and maximum risk of the bodies near a segment.
  struct Meeting {
    double gap = infinity;  ///< [µm]
    double risk = 0;        ///< cost per second
  };

  /// A body slower than `slow_speed` [µm/s] may be taken as it is now.
  ObstacleHorizon(const PredictiveParams& params, double slow_speed)
      : risk_(params.risk),
        closing_time_(params.tuning.closing_time),
        slow_speed_(slow_speed),
        outliner_(params.tuning.outline) {}

  /// Predicts the bodies of the predictor's newest frame from the time `effect` [s] on, at which
  /// the command of the step takes effect. A hollow body that hardly moves, such as a channel with
  /// moving walls, is taken as it is now if its hull contains one of `positions`.
  void update(const Snapshot& world, const MultiModelPredictor& predictor, const TimeField& field,
              double effect, std::span<const Vec2> positions);

  std::span<const ConvexOutline> outlines() const { return std::span(outlines_).first(size()); }
  /// Predicted bodies at the samples of the field, one sample after another, and at one of them.
  std::span<const PredictedBody> samples() const { return ahead_; }
  std::span<const PredictedBody> sample(int number) const { return part(ahead_, number); }
  /// Number of predicted bodies.
  std::size_t size() const { return body_of_.size(); }
  /// Distance of a position from the outline of predicted body `i` [µm].
  double distance_to(std::size_t i, const PredictedBody& body, Vec2 p) const {
    return outlines_[i].distance_at(rotated(p - body.centre, -body.turn)) - body.growth;
  }
  /// Bodies along a segment of the first leg of a swarm with this radius [µm].
  Meeting meeting(int piece, Segment move, double radius) const;
  /// Distance from the bodies taken as they are now, less their approach; only known up to `limit`
  /// [µm].
  double present_clearance(Vec2 p, double limit) const {
    return nonconvex_.empty() ? infinity : nonconvex_.clearance(p, limit + closing_) - closing_;
  }
  PredictiveDiagnostics diagnostics(const TimeField& field, double radius) const;

 private:
  std::span<const PredictedBody> part(std::span<const PredictedBody> all, int number) const {
    return all.subspan(static_cast<std::size_t>(number) * size(), size());
  }

  RiskParams risk_;
  double closing_time_;
  double slow_speed_;
  ConvexOutliner outliner_;
  std::vector<ConvexOutline> outlines_;  ///< of the predicted bodies, then unused ones
  std::vector<std::size_t> body_of_;     ///< index in the frame
  double effect_ = 0;
  std::vector<PredictedBody> ahead_;      ///< at the samples of the field
  std::vector<PredictedBody> leg_ahead_;  ///< at the ends of the segments of the first leg
  std::vector<Body> nonconvex_bodies_;
  BodySet nonconvex_;   ///< bodies taken as they are now
  double closing_ = 0;  ///< upper bound of their approach in the meantime [µm]
};

}  // namespace microswarm::navigation
