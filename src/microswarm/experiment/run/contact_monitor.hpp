// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/experiment/run/frame.hpp"
#include "microswarm/experiment/run/metrics.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// `RunEvent::body` of a touch of the map's border.
inline constexpr std::uint32_t border_body = 0xffffffff;

/// Watches how near a moving swarm comes to walls and to moving obstacles, between the ticks too:
/// distances change by at most the speeds' sum, so that the times at which something could be
/// nearer than anything before are bisected until the least distance is known to `resolution`.
class ContactMonitor {
 public:
  static constexpr double resolution = 0.02;  ///< [µm]

  /// The world must outlive the watch. Closer to the centre than the swarm is wide is a touch.
  explicit ContactMonitor(const World& world);

  /// To be called when the world's obstacles are others than before.
  void take_obstacles();

  /// Follows the way `trajectory`, which begins at time t0, and returns the touches that begin in
  /// it, in order of time. Obstacles that were touched at the end of the last way do not begin
  /// anew.
  std::vector<RunEvent> follow(double t0, std::span<const PoseStamped> trajectory);

  const LeastClearance& walls() const { return walls_; }
  const LeastClearance& obstacles() const { return obstacles_; }
  /// Least distance from the swarm's edge to an obstacle, below 0 when it touched one [µm].
  double min_gap() const { return min_gap_; }

 private:
  struct Sample {
    double t = 0;
    double clearance = 0;
    double gap = 0;  ///< the same from the swarm's edge, below 0 inside
  };
  struct Way;

  Sample sample(const Way& way, std::uint32_t obstacle, double t);
  std::optional<Sample> first_touch(const Way& way, std::uint32_t obstacle);
  std::optional<RunEvent> wall_touch(const Way& way);

  const World* world_;
  std::vector<double> top_speeds_;
  LeastClearance walls_;
  LeastClearance obstacles_;
  double min_gap_ = std::numeric_limits<double>::infinity();
  std::vector<bool> touching_;
  bool touching_wall_ = false;
  std::vector<Body> bodies_;
};

/// When [s, counted as in `trajectory`] the way first comes within `tolerance` of the goal.
std::optional<double> first_arrival(std::span<const PoseStamped> trajectory, Vec2 goal,
                                    double tolerance);

/// Where the swarm is on its way at time t, clamped to its ends; the way must not be empty.
PoseStamped moment_on(std::span<const PoseStamped> trajectory, double t);

}  // namespace microswarm
