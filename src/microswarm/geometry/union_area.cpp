// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/union_area.hpp"

#include <vector>

#include "microswarm/geometry/arc_area.hpp"
#include "microswarm/geometry/outline_area.hpp"
#include "microswarm/geometry/slab_area.hpp"

namespace microswarm {

namespace {

constexpr std::size_t many = 64;  // discs, or discs and edges

}  // namespace

double union_area(double radius, std::span<const NearObstacle> obstacles,
                  std::pmr::memory_resource& memory, const Stop& stop) {
  const NearObstacle* polygon = nullptr;
  std::pmr::vector<Disc> discs(&memory);
  for (const NearObstacle& o : obstacles) {
    if (o.is_disc) {
      discs.push_back(o.disc);
    } else if (polygon) {
      return slab_area(radius, obstacles, memory, stop);
    } else {
      polygon = &o;
    }
  }
  const std::span<const Segment> edges = polygon ? polygon->edges : std::span<const Segment>{};
  const int winding = polygon ? polygon->winding : 0;
  if (discs.size() <= many) {
    if (const auto area = outline_area(radius, edges, winding, discs, memory)) return *area;
    if (discs.size() + edges.size() <= many) return slab_area(radius, obstacles, memory, stop);
  }
  return arc_area(radius, edges, winding, discs, memory, stop);
}

}  // namespace microswarm
