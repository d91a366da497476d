// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/follow_monitor.hpp"

namespace microswarm {

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
  return min_share_ <= 0 || commanded_ < distance || followed_ >= min_share_ * commanded_;
}

}  // namespace microswarm
