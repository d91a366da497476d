// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "microswarm/world/obstacles/obstacle.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// Map and moving obstacles. A value; copies share the map.
struct World {
  std::shared_ptr<const Map> map{};
  std::vector<Obstacle> obstacles{};

  /// Snapshot at time t [s].
  Snapshot at(double t) const;
};

}  // namespace microswarm
