// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/navigation/prediction/convex_outline.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"
#include "microswarm/navigation/safe_interval/resting_bodies.hpp"
#include "microswarm/navigation/safe_interval/safe_interval_params.hpp"
#include "microswarm/planning/space_time/space_time_grid.hpp"

namespace microswarm::navigation {

/// Extent of a body in a row of the grid [µm].
struct RowExtent {
  double left = infinity;
  double right = -infinity;
  void add(double x) {
    left = std::min(left, x);
    right = std::max(right, x);
  }
};

/// Moving bodies as predicted over the horizon, at the ends and the middles of the grid's slots.
/// Time 0 is that at which the command of the step takes effect. A hollow body that hardly moves,
/// such as a channel with moving walls, is not predicted but taken as it is now, less what it may
/// close in. Allocates only if there are more bodies than ever before.
class ObstacleForecast {
 public:
  static constexpr int slots = 64;  ///< of the horizon

  /// `speed` is the swarm's [µm/s].
  ObstacleForecast(const SafeIntervalParams& params, double speed);

  /// Processes the predictor's newest frame, of the world; the command takes effect at the time
  /// `effect` [s]. Hulls that contain one of `positions` are not used for hollow bodies.
  void update(const Snapshot& world, const MultiModelPredictor& predictor, double effect,
              std::span<const Vec2> positions);
  /// Predicts until the end of the horizon, if it has not been done for this frame.
  void predict_all(const MultiModelPredictor& predictor) { predict_until(predictor, last_sample_); }

  /// Measures the gaps between the bodies and a swarm of a radius [µm] at `position` at time 0.
  void measure_from(Vec2 position, double radius);
  /// The gap of a body then [µm], and the least one; infinity without bodies.
  double present_gap(std::size_t i) const { return present_gaps_[i]; }
  double min_current_gap() const;

  /// Time from the newest frame to time 0 [s].
  double late() const { return late_; }
  /// Time between two samples [s].
  double step() const { return step_; }
  /// Number of samples over the horizon, after the one at time 0.
  int samples() const { return last_sample_; }
  /// Number of the last sample until which update() predicts.
  int near_samples() const { return near_samples_; }
  std::size_t size() const { return bodies_.size(); }
  const ConvexOutline& outline(std::size_t i) const { return outlines_[i]; }
  const PredictedBody& at(int sample, std::size_t i) const {
    return ahead_[static_cast<std::size_t>(sample) * size() + i];
  }
  bool rests(std::size_t i) const { return bodies_[i].rests; }
  /// Standard deviation of an observed coordinate of the body [µm].
  double noise(std::size_t i) const { return bodies_[i].noise; }
  /// Way [µm] of a body that turns without notice, until the swarm answers.
  double turn_reach(std::size_t i) const { return bodies_[i].turn_reach; }
  /// Gap [µm] that a plan keeps from a body at a sample, including its uncertainty.
  double gap(int sample, std::size_t i) const;
  /// Gap [µm] between a swarm of a radius [µm] that moves straight during the time after a sample,
  /// and a body; beyond `near` [µm] it may be more.
  double gap_along(Segment move, int sample, std::size_t i, double radius, double near) const {
    return gap_along(move, at(sample, i), at(sample + 1, i), i, radius, near);
  }
  /// Observed speed of a body [µm/s]; 0 if it rests.
  double speed(std::size_t i) const { return bodies_[i].rests ? 0 : norm(bodies_[i].velocity); }
  /// The same gap if the body has turned round just after the newest frame.
  double gap_if_turned(Segment move, int sample, std::size_t i, double radius, double near) const {
    return gap_along(move, turned_round(sample, i), turned_round(sample + 1, i), i, radius, near);
  }

  /// Hollow bodies taken as they are now.
  const BodySet& hollow() const { return hollow_; }
  /// Distance [µm] from them, less their approach; only known up to `limit` [µm].
  double hollow_clearance(Vec2 p, double limit) const {
    return hollow_.empty() ? infinity : hollow_.clearance(p, limit + closing_) - closing_;
  }
  /// Upper bound of their approach [µm].
  double closing() const { return closing_; }
  /// Identifies the bodies that rest and the hollow ones, to notice a change.
  std::span<const Disc> standing() const { return standing_; }

  /// Occupies the cells near the bodies in each slot, with `share` of the gaps, for a swarm of this
  /// radius [µm]. Bodies that rest are left out if `without_resting`.
  void occupy(planning::SpaceTimeGrid& grid, double radius, double share,
              bool without_resting) const;
  /// Lets the cells near the bodies that rest stand.
  void let_resting_stand(planning::SpaceTimeGrid& grid, double radius, double gap) const;

  PredictiveDiagnostics diagnostics(double radius) const;

 private:
  struct Seen {
    std::size_t index = 0;  ///< in the frame
    double noise = 0;       ///< [µm]
    bool rests = false;
    double turn_reach = 0;  ///< [µm]
    Vec2 centre{};          ///< in the frame
    Vec2 velocity{};        ///< [µm/s]
    bool hidden = false;    ///< not in the frame; `index` is the predictor's of the hidden ones
  };

  void predict_until(const MultiModelPredictor& predictor, int sample);
  double gap_along(Segment move, const PredictedBody& a, const PredictedBody& b, std::size_t i,
                   double radius, double near) const;
  PredictedBody turned_round(int sample, std::size_t i) const;
  PredictedBody predicted(const MultiModelPredictor& predictor, std::size_t i, double t) const;
  void occupy_slot(planning::SpaceTimeGrid& grid, std::size_t i, int slot, double keep) const;

  SafeIntervalParams params_;
  double slow_speed_;
  double step_;
  int last_sample_;
  int near_samples_;
  ConvexOutliner outliner_;
  RestingBodies resting_;
  double effect_ = 0;
  double late_ = 0;                      ///< effect_ less the time of the frame [s]
  std::vector<Seen> bodies_;             ///< the predicted ones
  std::vector<ConvexOutline> outlines_;  ///< of the predicted bodies, then unused ones
  std::vector<PredictedBody> ahead_;     ///< by sample, then by body
  int predicted_ = 0;                    ///< number of predicted samples
  std::vector<double> present_gaps_;
  std::vector<Body> hollow_bodies_;  ///< those that are hollow, then unused ones
  BodySet hollow_;
  double closing_ = 0;
  std::vector<Disc> standing_;
  mutable std::vector<RowExtent> extents_;  ///< a buffer
};

}  // namespace microswarm::navigation
