// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/follow_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::rig {

bool FollowMonitor::take(double commanded, double followed, double distance) {
  if (commanded <= 0) return true;
  steps_.push_back({commanded, followed});
  commanded_ += commanded;
  followed_ += followed;
  while (commanded_ - steps_.front().commanded >= distance) {
    commanded_ -= steps_.front().commanded;
    followed_ -= steps_.front().followed;
    steps_.pop_front();
  }
  if (commanded_ < distance) return true;
  return (min_share_ <= 0 || followed_ >= min_share_ * commanded_) &&
         (max_share_ <= 0 || followed_ <= max_share_ * commanded_);
}

void FollowAngle::take(double commanded, double followed, double across, double stretch) {
  if (commanded <= 0) return;
  commanded_ += commanded;
  followed_ += followed;
  across_ += across;
  if (commanded_ < stretch) return;
  commanded_squares_ += commanded_ * commanded_;
  along_ += commanded_ * followed_;
  left_ += commanded_ * across_;
  seen_squares_ += followed_ * followed_ + across_ * across_;
  ++stretches_;
  commanded_ = followed_ = across_ = 0;
}

std::optional<FollowDirection> FollowAngle::direction() const {
  constexpr int enough = 5;
  const double moved = norm({along_, left_});
  if (stretches_ < enough || moved <= 0) return std::nullopt;
  // Model: the observed displacement is the commanded one, rotated and scaled, with isotropic
  // noise.
  const double rest = std::max(0.0, seen_squares_ - moved * moved / commanded_squares_);
  const double spread = std::sqrt(rest / (2 * (stretches_ - 1)));
  return FollowDirection{maths::atan2(left_, along_),
                         spread * std::sqrt(commanded_squares_) / moved,
                         moved / commanded_squares_};
}

}  // namespace microswarm::rig
