// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm {

/// Rectangle around a valve in which the swarm waits while the gap is too small: A and D of Eq 29
/// [radar].
struct WaitZone {
  Vec2 centre{};
  double width = 1000;
  double height = 1000;
  double heading = 0;
  double min_gap = 500;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, {"centre", Unit::um, coordinates, "Centre of the zone.", true});
    visit(self.width, {"width", Unit::um, {1e-3, 1e6}, "Extent along its heading.", true});
    visit(self.height, {"height", Unit::um, {1e-3, 1e6}, "Extent across its heading.", true});
    visit(self.heading, {"heading", Unit::deg, {-360, 360}, "Orientation of the zone."});
    visit(self.min_gap, {"min_gap",
                         Unit::um,
                         {0, 1e6},
                         "Gap of the valve below which it waits (D).",
                         true,
                         "least_gap_um"});
  }
};

}  // namespace microswarm
