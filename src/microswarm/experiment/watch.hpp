// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/experiment/frame.hpp"
#include "microswarm/experiment/metrics.hpp"

namespace microswarm {

/// `RunEvent::body` of a touch of the map's border.
inline constexpr std::uint32_t border_body = 0xffffffff;

/// Watches how near a moving swarm comes to walls and to moving obstacles, between the ticks too:
/// distances change by at most the speeds' sum, so that the times at which something could be
/// nearer than anything before are bisected until the least distance is known to `resolution`.
class Watch {
 public:
  static constexpr double resolution = 0.02;  ///< [µm]

  /// The world must outlive the watch. Closer to the centre than `radius` is a touch.
  Watch(const World& world, double radius);

  /// Follows the way `swept`, which begins at time t0, and returns the touches that begin in it, in
  /// order of time. Obstacles that were touched at the end of the last way do not begin anew.
  std::vector<RunEvent> follow(double t0, std::span<const TimedPose> swept);

  const LeastClearance& walls() const { return walls_; }
  const LeastClearance& obstacles() const { return obstacles_; }

 private:
  struct Sample {
    double t = 0;
    double clearance = 0;
  };
  struct Way;

  Sample sample(const Way& way, std::uint32_t obstacle, double t);
  std::optional<Sample> first_touch(const Way& way, std::uint32_t obstacle);
  std::optional<RunEvent> wall_touch(const Way& way);

  const World* world_;
  double radius_;
  std::vector<double> top_speeds_;
  LeastClearance walls_;
  LeastClearance obstacles_;
  std::vector<bool> touching_;
  bool touching_wall_ = false;
  std::vector<Body> bodies_;
};

/// When [s, counted as in `swept`] the way first comes within `tolerance` of the goal.
std::optional<double> first_arrival(std::span<const TimedPose> swept, Vec2 goal, double tolerance);

/// Pose on the way at time t, clamped to its ends; the way must not be empty.
Pose2 pose_on(std::span<const TimedPose> swept, double t);

}  // namespace microswarm
