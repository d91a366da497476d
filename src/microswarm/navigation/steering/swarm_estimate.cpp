// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/swarm_estimate.hpp"

#include <algorithm>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {
namespace {

constexpr double least_noise = 1e-4;  // [µm²]; below it frames are exact

}  // namespace

SwarmPose SwarmEstimate::update(const SwarmPose& seen, double t, const DelayCompensator& commands) {
  if (shown_ && t <= t_) return current();
  if (shown_) {
    const double dt = t - t_;
    bridge(t, commands);
    correct(seen.pose.position, 1 - maths::exp(-dt / memory_), dt);
  } else {
    positions_.fill(seen.pose.position);
  }
  shown_ = t_ = t;
  heading_ = seen.pose.heading;
  radius_ = seen.radius;
  return current();
}

SwarmPose SwarmEstimate::bridge(double t, const DelayCompensator& commands) {
  Pose2 moved{{}, heading_};
  for (std::size_t i = 0; i < count; ++i) {
    moved = commands.moved({positions_[i], heading_}, t_, t);
    positions_[i] = moved.position + std::max(0.0, t - t_) * flows_[i];
  }
  heading_ = moved.heading;
  t_ = std::max(t_, t);
  return current();
}

void SwarmEstimate::correct(Vec2 seen, double share, double dt) {
  for (std::size_t i = 0; i < count; ++i) {
    const double gain = gains[i % gains.size()];
    const Vec2 difference = seen - positions_[i];
    squares_[i] += share * (0.5 * squared_norm(difference) - squares_[i]);
    positions_[i] = gain == 1 ? seen : positions_[i] + gain * difference;
    // Gain of the velocity: Benedict and Bordner, IRE Transactions on Automatic Control 7 (1962).
    if (i >= gains.size()) flows_[i] += (gain * gain / (2 - gain) / dt) * difference;
  }
  const auto least = std::min_element(squares_.begin(), squares_.end());
  best_ = squares_[0] < least_noise ? 0 : static_cast<std::size_t>(least - squares_.begin());
}

}  // namespace microswarm::navigation
