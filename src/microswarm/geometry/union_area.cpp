// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/union_area.hpp"

#include <optional>
#include <vector>

#include "microswarm/geometry/outline_area.hpp"
#include "microswarm/geometry/slab_area.hpp"

namespace microswarm {

double union_area(double radius, std::span<const NearObstacle> obstacles,
                  std::pmr::memory_resource& memory) {
  const NearObstacle* polygon = nullptr;
  std::pmr::vector<Disc> discs(&memory);
  for (const NearObstacle& o : obstacles) {
    if (o.is_disc) {
      discs.push_back(o.disc);
    } else if (polygon) {
      return slab_area(radius, obstacles, memory);
    } else {
      polygon = &o;
    }
  }
  const std::optional<double> area =
      polygon ? outline_area(radius, polygon->edges, polygon->winding, discs, memory)
              : outline_area(radius, {}, 0, discs, memory);
  return area ? *area : slab_area(radius, obstacles, memory);
}

}  // namespace microswarm
