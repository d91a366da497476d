// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/navigation/radar/radar_scan.hpp"

namespace microswarm::reproduce {

/// A run of the radar with the inputs of each decision.
struct RadarRun {
  experiment::Record record{};
  /// One per frame; the end repeats the last one. Empty where the radar did not look.
  std::vector<std::optional<navigation::RadarLook>> looks{};

  bool collided() const { return record.result.status == Status::collided; }
  bool crossed() const { return record.result.status == Status::solved; }
};

/// Runs a trial of a scenario whose navigator is the radar.
RadarRun run_radar(const experiment::Scene& scene, const World& world, const Stop& stop,
                   std::uint32_t trial = 0);

/// Index of the last frame at or before time t [s].
std::size_t frame_at(const experiment::Record& record, double t);

/// A time interval [s].
struct Period {
  double from = 0;
  double to = 0;
};

/// Intervals in which an obstacle was in the detection circle.
std::vector<Period> periods_detected(const experiment::Record& record);

/// First time at which the avoidance cost exceeds `cost` [s].
std::optional<double> cost_above(const experiment::Record& record, double cost);

/// Side on which the swarm passed the only obstacle, seen from start to goal: 1 with the obstacle
/// on its left, -1 on its right.
int side_passed(const experiment::Record& record);

}  // namespace microswarm::reproduce
