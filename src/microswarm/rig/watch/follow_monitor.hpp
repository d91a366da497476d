// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

namespace microswarm::rig {

/// Checks whether a swarm follows its commands: over a commanded distance, the observed distance
/// along it must be at least a given share. A dead amplifier, exchanged coils or a turned camera
/// fail.
class FollowMonitor {
 public:
  /// `min_share` of the commanded distance must be followed, at most `max_share` of it; 0 disables
  /// the check.
  explicit FollowMonitor(double min_share, double max_share = 0)
      : min_share_(min_share), max_share_(max_share) {}

  /// Takes the commanded distance between two pictures and the observed distance along it [µm].
  /// Returns false if the swarm did not follow over the last `distance` µm commanded, or went
  /// farther.
  bool take(double commanded, double followed, double distance);

  double commanded() const { return commanded_; }  ///< within the window [µm]
  double followed() const { return followed_; }    ///< within the window [µm]

 private:
  struct Step {
    double commanded;
    double followed;
  };

  double min_share_;
  double max_share_;
  std::deque<Step> steps_;
  double commanded_ = 0;
  double followed_ = 0;
};

/// Direction in which a swarm moves, relative to that of its commands.
struct FollowDirection {
  double angle = 0;  ///< counter-clockwise [rad]
  double sd = 0;     ///< standard deviation of the angle [rad]
  double share = 0;  ///< observed over commanded distance
};

/// Estimates the direction in which a swarm moves, relative to its commands, by least squares over
/// stretches of its path. A camera that is rotated against the coils shows as an angle.
class FollowAngle {
 public:
  /// Takes the commanded distance between two pictures and the observed displacement along it and
  /// to its left [µm]. A stretch ends after `stretch` µm commanded.
  void take(double commanded, double followed, double across, double stretch);
  /// The estimate; nothing before five stretches, or without motion.
  std::optional<FollowDirection> direction() const;

 private:
  double commanded_ = 0, followed_ = 0, across_ = 0;  // of the current stretch
  double commanded_squares_ = 0, along_ = 0, left_ = 0, seen_squares_ = 0;  // sums over stretches
  int stretches_ = 0;
};

}  // namespace microswarm::rig
