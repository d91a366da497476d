// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields.hpp"
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
    visit(self.centre, {"centre", Unit::um, coordinates, "Middle of the area.", true});
    visit(self.width, {"width", Unit::um, {1e-3, 1e6}, "Along its heading.", true});
    visit(self.height, {"height", Unit::um, {1e-3, 1e6}, "Across its heading.", true});
    visit(self.heading, {"heading", Unit::deg, {-360, 360}, "How it is turned."});
    visit(self.min_gap,
          {"least_gap", Unit::um, {0, 1e6}, "Wait while the gap is smaller (D).", true});
  }
};

}  // namespace microswarm
