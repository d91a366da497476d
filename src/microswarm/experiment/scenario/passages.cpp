// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/passages.hpp"

#include <fmt/format.h>

#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/world/connectivity/passage.hpp"

namespace microswarm::experiment {

bool leads_to(const Map& map, Vec2 from, Vec2 to, double clearance) {
  constexpr double rounding = 1e-9;  // of a clearance that was measured at a point
  return planning::ShortestPaths(map, (1 - rounding) * clearance).find(from, to).status ==
         Status::solved;
}

std::string tightest_text(const Map& map, Vec2 from, Vec2 to, double enough) {
  const WidestPath path = widest_path(map, from, to, enough);
  if (!path.found) return {};
  return fmt::format(": about {:.3g} µm are left at ({:.4g}, {:.4g}) µm", path.clearance,
                     path.tightest.x, path.tightest.y);
}

}  // namespace microswarm::experiment
