// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "microswarm/navigation/steering/delay_compensator.hpp"

namespace microswarm::navigation {

/// Estimates the drift velocity of a swarm: low-pass of (observed − predicted displacement) / dt.
/// The drift is a flow, or a speed that differs from the commanded one. The time constant of some
/// seconds removes the camera's noise.
class FlowEstimate {
 public:
  /// Adds a frame with a swarm, before `compensator` drops the commands since the last one.
  void update(const Observation& seen, const DelayCompensator& compensator) {
    const PoseStamped now{seen.seen, seen.swarm->pose, seen.swarm->radius};
    if (last_ && now.t - last_->t > min_gap && now.t - last_->t < max_gap) {
      const double dt = now.t - last_->t;
      const Vec2 expected = compensator.moved(last_->pose, last_->t, now.t).position;
      const Vec2 measured = (1 / dt) * (now.pose.position - expected);
      flow_ += std::min(1.0, dt / time_constant) * (measured - flow_);
    }
    if (!last_ || now.t - last_->t > min_gap) last_ = now;
  }

  Vec2 flow() const { return flow_; }  ///< [µm/s]

 private:
  static constexpr double time_constant = 1.5;  // [s]
  static constexpr double min_gap = 1e-6;       // between two frames [s]
  static constexpr double max_gap = 1.0;        // between comparable frames [s]
  std::optional<PoseStamped> last_;
  Vec2 flow_;
};

}  // namespace microswarm::navigation
