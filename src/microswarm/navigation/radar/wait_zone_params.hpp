// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm::navigation {

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
    visit(self.centre, um("centre", coordinates, "Centre of the zone.").needed());
    visit(self.width, um("width", 1e-3, 1e6, "Extent along its heading.").needed());
    visit(self.height, um("height", 1e-3, 1e6, "Extent across its heading.").needed());
    visit(self.heading, deg("heading", -360, 360, "Orientation of the zone."));
    visit(self.min_gap, um("min_gap", 0, 1e6, "Gap of the valve below which it waits (D).")
                            .needed()
                            .formerly("least_gap_um"));
  }
};

}  // namespace microswarm::navigation
