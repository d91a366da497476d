// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/navigation/prediction/obstacle_tracker.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// Predicts moving obstacles for a few seconds: each goes straight on with the velocity that
/// ObstacleTracker estimates from the frames, and its outline goes on growing for 2 s.
class ObstaclePredictor {
 public:
  explicit ObstaclePredictor(const ObstacleTrackerParams& params = {}) : tracker_(params) {}

  /// Takes a frame; see ObstacleTracker::see. What follows is about the newest frame.
  void update(const Observation& observation);

  /// Does no body move from its place, as far as the frames tell? Outlines may still deform.
  bool all_rest() const { return all_rest_; }

  /// Least distance [µm] between a point that runs straight from s.a at time t0 to s.b at t1 [s
  /// after the frame] and the predicted bodies of `frame`, the world of the newest observation; at
  /// most `limit`. Exact in continuous time: every body is asked in its own frame of reference, in
  /// which the point runs along a straight segment too.
  double clearance(const Snapshot& frame, Segment s, double t0, double t1, double limit) const;

  /// The frame with every moving body swept along its predicted way of the next `horizon` seconds,
  /// so that a plan made on it with the clearance `r` keeps out of the way of what is coming.
  Snapshot swept_obstacles(const Snapshot& frame, double horizon, double r) const;

 private:
  struct Motion {
    Vec2 velocity;      ///< [µm/s]
    double growth = 0;  ///< of the outline, outwards [µm/s]
  };

  ObstacleTracker tracker_;
  std::vector<Motion> motions_;  ///< of the frame's bodies
  bool all_rest_ = true;
};

}  // namespace microswarm
