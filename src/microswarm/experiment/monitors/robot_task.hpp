// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/planning/exact/distance_field.hpp"

namespace microswarm::experiment {

/// Task of individually tracked robots, measured on their positions: each reaches its own goal
/// [global], or all gather at one goal [gather].
class RobotTask {
 public:
  /// The scenario must have robots; the map must outlive the task.
  RobotTask(const Scenario& scenario, const Map& map);

  /// Remaining distance [µm]: the maximum distance of a robot from its own goal, or the mean path
  /// length to the common goal through free space, F(n, t) [gather].
  double left(std::span<const Vec2> robots);

 private:
  struct Known {
    Vec2 position{std::numeric_limits<double>::quiet_NaN(), 0};
    double remaining = 0;
  };

  double remaining_from(Vec2 position);

  std::vector<Vec2> goals_;
  std::optional<planning::DistanceField> field_;
  std::vector<Known> known_;  // cache, since robots that rest or have merged are queried repeatedly
};

}  // namespace microswarm::experiment
