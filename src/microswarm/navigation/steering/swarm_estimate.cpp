// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/steering/swarm_estimate.hpp"

#include <algorithm>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {
namespace {

constexpr double min_noise = 1e-4;    // [µm²]; below it frames are exact
constexpr double needed_share = 0.9;  // of the squares, for a response that is not as commanded

}  // namespace

SwarmPose SwarmEstimate::update(const SwarmPose& seen, double t, const DelayCompensator& commands) {
  if (shown_ && t <= t_) return current();
  if (shown_) {
    const double dt = t - t_;
    bridge(t, commands);
    correct(seen.pose.position, 1 - maths::exp(-dt / memory_));
  } else {
    positions_.fill(seen.pose.position);
  }
  fit_.add(t, seen.pose.position, commanded_);
  shown_ = t_ = t;
  heading_ = seen.pose.heading;
  radius_ = seen.radius;
  return current();
}

SwarmPose SwarmEstimate::bridge(double t, const DelayCompensator& commands) {
  const Pose2 moved = commands.moved({{}, heading_}, t_, t);
  commanded_ += moved.position;
  for (std::size_t i = 0; i < count; ++i)
    positions_[i] = response_of(i).moved(positions_[i], moved.position, std::max(0.0, t - t_));
  heading_ = moved.heading;
  t_ = std::max(t_, t);
  return current();
}

void SwarmEstimate::correct(Vec2 seen, double share) {
  for (std::size_t i = 0; i < count; ++i) {
    const double gain = gains[i % gains.size()];
    const Vec2 difference = seen - positions_[i];
    squares_[i] += share * (0.5 * squared_norm(difference) - squares_[i]);
    positions_[i] = gain == 1 ? seen : positions_[i] + gain * difference;
  }
  best_ = 0;
  if (squares_[0] < min_noise) return;
  for (std::size_t i = 1; i < count; ++i) {
    const double needed = i < gains.size() || best_ >= gains.size() ? 1 : needed_share;
    if (squares_[i] < needed * squares_[best_]) best_ = i;
  }
}

}  // namespace microswarm::navigation
