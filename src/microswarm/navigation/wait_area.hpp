// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/core/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/world/body_set.hpp"
#include "microswarm/world/motion.hpp"

namespace microswarm {

/// Rectangle around a valve in which the swarm waits while the gap is too small: A and D of Eq 29
/// [radar].
struct WaitArea {
  Vec2 centre{};
  double width = 1000;
  double height = 1000;
  double heading = 0;
  double least_gap = 500;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.centre, {"centre", Unit::um, coordinates, "Middle of the area.", true});
    visit(self.width, {"width", Unit::um, {1e-3, 1e6}, "Along its heading.", true});
    visit(self.height, {"height", Unit::um, {1e-3, 1e6}, "Across its heading.", true});
    visit(self.heading, {"heading", Unit::deg, {-360, 360}, "How it is turned."});
    visit(self.least_gap,
          {"least_gap", Unit::um, {0, 1e6}, "Wait while the gap is smaller (D).", true});
  }
};

/// Where a swarm is that may have to wait, and where it is going.
struct Waiting {
  Vec2 position;      ///< of its centre [µm]
  double radius = 0;  ///< [µm]
  double reach = 0;   ///< nearer to the leaves' way than this it does not wait [µm]
  Vec2 target;        ///< [µm]
};

/// Is the point in the area?
bool is_in(const WaitArea& area, Vec2 p);

/// Its rectangle.
Polygon outline_of(const WaitArea& area);

/// Distance [µm] between two bodies, 0 when they touch or overlap.
double gap_between(const Body& a, const Body& b);

/// Eq 29 [radar]: is some part of the swarm in the area, and the gap of a valve there, two bodies
/// of one obstacle, below the least? Not so when the swarm has passed the valve, its target being
/// on the same side, nor when it is within reach of the leaves: there it must go on or get out,
/// lest they close on it.
bool must_wait(const WaitArea& area, std::span<const Body> bodies, const Waiting& swarm);

}  // namespace microswarm
