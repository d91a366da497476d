// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/world.hpp"

#include <utility>

namespace microswarm {

Snapshot World::at(double t) const {
  std::vector<Body> bodies;
  bodies.reserve(obstacles.size());
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    append_bodies(obstacles[i], static_cast<std::uint32_t>(i), t, bodies);
  }
  return Snapshot(map, t, std::move(bodies));
}

}  // namespace microswarm
