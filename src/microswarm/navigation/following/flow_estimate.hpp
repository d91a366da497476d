// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "microswarm/navigation/steering/delay_compensator.hpp"

namespace microswarm {

/// Tells what carries a swarm off from where it is seen, frame by frame, beside where its commands
/// would have taken it: a flow, or a speed that is not the one commanded. A low-pass over some
/// seconds takes out the camera's noise.
class FlowEstimate {
 public:
  /// Takes in a frame with a swarm, before `compensator` forgets the commands since the last one.
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
  static constexpr double min_gap = 1e-6;       // of two frames [s]
  static constexpr double max_gap = 1.0;        // beyond it the frames have nothing in common [s]
  std::optional<PoseStamped> last_;
  Vec2 flow_;
};

}  // namespace microswarm
