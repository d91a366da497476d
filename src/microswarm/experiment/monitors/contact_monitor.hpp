// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/experiment/results/frame.hpp"
#include "microswarm/experiment/results/metrics.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {

/// `RunEvent::body` of a contact with the map's border.
inline constexpr std::uint32_t border_body = 0xffffffff;

/// Monitors the clearance of a moving swarm to walls and moving obstacles, between ticks too. Since
/// distances change at most by the sum of the speeds, intervals that may contain a new minimum are
/// bisected until it is known to `resolution`.
class ContactMonitor {
 public:
  static constexpr double resolution = 0.02;  ///< [µm]

  /// `world` must outlive the monitor. A clearance from the centre below the swarm's radius is a
  /// contact.
  explicit ContactMonitor(const World& world);

  /// Must be called after the world's obstacles change.
  void take_obstacles();

  /// Follows `trajectory`, which starts at time t0, and returns the contacts that begin on it,
  /// sorted by time. Contacts that last from the end of the previous trajectory are not reported
  /// again.
  std::vector<RunEvent> follow(double t0, std::span<const PoseStamped> trajectory);

  const LeastClearance& walls() const { return walls_; }
  const LeastClearance& obstacles() const { return obstacles_; }
  /// Minimum distance from the swarm's edge to an obstacle, negative for a contact [µm].
  double min_gap() const { return min_gap_; }

 private:
  struct Sample {
    double t = 0;
    double clearance = 0;
    double gap = 0;  ///< clearance from the swarm's edge, negative inside
  };
  struct Course;

  Sample sample(const Course& course, std::uint32_t obstacle, double t);
  std::optional<Sample> first_touch(const Course& course, std::uint32_t obstacle);
  std::optional<RunEvent> wall_touch(const Course& course);

  const World* world_;
  std::vector<double> top_speeds_;
  LeastClearance walls_;
  LeastClearance obstacles_;
  double min_gap_ = std::numeric_limits<double>::infinity();
  std::vector<bool> touching_;
  bool touching_wall_ = false;
  std::vector<Body> bodies_;
};

/// Pose on a non-empty trajectory at time t, clamped to its ends.
PoseStamped moment_on(std::span<const PoseStamped> trajectory, double t);

}  // namespace microswarm::experiment
