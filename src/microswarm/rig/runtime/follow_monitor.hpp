// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

namespace microswarm {

/// Judges whether a swarm follows its commands: over a commanded way, the part of it that was seen
/// must be at least a given share. A dead amplifier, exchanged coils or a turned camera fail.
class FollowMonitor {
 public:
  /// `min_share` of the commanded way must be followed; 0: none needs to be.
  explicit FollowMonitor(double min_share) : min_share_(min_share) {}

  /// Takes the commanded way between two pictures and the part of it that was seen [µm]. Returns
  /// false if the swarm does not follow over the last `distance` µm of commanded way.
  bool take(double commanded, double followed, double distance);

  double commanded() const { return commanded_; }  ///< over the window [µm]
  double followed() const { return followed_; }    ///< over the window [µm]

 private:
  struct Step {
    double commanded;
    double followed;
  };

  double min_share_;
  std::deque<Step> steps_;
  double commanded_ = 0;
  double followed_ = 0;
};

}  // namespace microswarm
