// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/navigation/prediction/obstacle_predictor_tuning.hpp"
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::navigation {

/// Predicts moving obstacles for a few seconds. Each moves straight with the velocity that
/// ObstacleTracker estimates from the frames; its outline keeps growing for a while.
class ObstaclePredictor {
 public:
  explicit ObstaclePredictor(const ObstacleTrackerParams& tracker = {},
                             const ObstaclePredictorTuning& tuning = {})
      : tuning_(tuning), tracker_(tracker) {}

  /// Processes a frame; see ObstacleTracker::update. The other members refer to the newest frame.
  void update(const Observation& observation);

  /// Whether no body changes its position, as far as the frames show. Outlines may still deform.
  bool all_rest() const { return all_rest_; }

  /// Minimum distance [µm] between a point that moves straight from s.a at time t0 to s.b at t1 [s
  /// after the frame] and the predicted bodies, at most `limit`. `frame` is the world of the newest
  /// observation. Exact in continuous time: each body is tested in its own frame of reference, in
  /// which the point moves along a segment too.
  double clearance(const Snapshot& frame, Segment s, double t0, double t1, double limit) const;

  /// The frame with every moving body swept along its predicted path over the next `horizon`
  /// seconds, so that a plan made on it with the clearance `r` avoids approaching obstacles.
  Snapshot swept_obstacles(const Snapshot& frame, double horizon, double r) const;

 private:
  struct Motion {
    Vec2 velocity;      ///< [µm/s]
    double growth = 0;  ///< of the outline, outwards [µm/s]
  };

  ObstaclePredictorTuning tuning_;
  ObstacleTracker tracker_;
  std::vector<Motion> motions_;  ///< of the frame's bodies
  bool all_rest_ = true;
};

}  // namespace microswarm::navigation
