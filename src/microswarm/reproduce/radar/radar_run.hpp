// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/navigation/radar/radar_scan.hpp"

namespace microswarm::reproduce {

/// A run of the radar with what each decision of it rested on.
struct RadarRun {
  Record record;
  /// One a frame, the last one's also for the end; nothing where it did not look.
  std::vector<std::optional<RadarLook>> looks;

  bool collided() const { return record.result.status == Status::collided; }
  bool crossed() const { return record.result.status == Status::solved; }
};

/// A trial of a scenario whose navigator is the radar.
RadarRun run_radar(const Scene& scene, const World& world, const Stop& stop,
                   std::uint32_t trial = 0);

/// The last frame at time t [s] or before, by its number.
std::size_t frame_at(const Record& record, double t);

/// A stretch of time [s].
struct Period {
  double from = 0;
  double to = 0;
};

/// When some obstacle was in the detection circle.
std::vector<Period> periods_detected(const Record& record);

/// When the avoidance cost was first above so much [s].
std::optional<double> cost_above(const Record& record, double cost);

/// On which side of the only obstacle it passed, going from start to goal: 1 with the obstacle to
/// its left, -1 to its right.
int side_passed(const Record& record);

}  // namespace microswarm::reproduce
