// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

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

/// Direction in which a swarm goes, relative to that of its commands.
struct FollowDirection {
  double angle = 0;  ///< counter-clockwise [rad]
  double sd = 0;     ///< standard deviation of the angle [rad]
  double share = 0;  ///< seen way over commanded way
};

/// Measures the direction in which a swarm goes, relative to its commands, by least squares over
/// stretches of way. A camera that is turned against the coils shows as an angle.
class FollowAngle {
 public:
  /// Takes the commanded way between two pictures, the part of it that was seen, and what was seen
  /// to its left [µm]. A stretch ends after `stretch` µm of commanded way.
  void take(double commanded, double followed, double across, double stretch);
  /// Nothing before five stretches, or if nothing moved.
  std::optional<FollowDirection> direction() const;

 private:
  double commanded_ = 0, followed_ = 0, across_ = 0;  // of the present stretch
  double commanded_squares_ = 0, along_ = 0, left_ = 0, seen_squares_ = 0;  // sums over stretches
  int stretches_ = 0;
};

}  // namespace microswarm
