// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/planning/common/distance_field.hpp"

namespace microswarm {

/// What robots have to do, measured on where they are: come to goals of their own [global], or
/// gather at one goal [gather].
class RobotTask {
 public:
  /// The scenario has robots; the map must outlive it.
  RobotTask(const Scenario& scenario, const Map& map);

  /// How far it is to the end [µm]: the worst robot's distance from its own goal, or the mean way
  /// to the common goal through the free space, F(n, t) [gather].
  double left(std::span<const Vec2> robots);

 private:
  struct Known {
    Vec2 place{std::numeric_limits<double>::quiet_NaN(), 0};
    double way = 0;
  };

  double way_from(Vec2 place);

  const Map* map_;
  std::vector<Vec2> goals_;
  std::optional<DistanceField> field_;
  std::vector<Known> known_;  // robots that rest, or were pushed together, are asked for again
};

}  // namespace microswarm
