// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::planning {

/// Parameters of segment_map. Lengths are in widths of the local channel, so they fit every map.
struct MapSegmentationParams {
  static constexpr std::string_view type_name = "map_segmentation";
  double eccentricity = 0.97;
  double range = 1;
  int arms = 3;
  double arm_gap = radians(20);
  double merge_distance = 0.4;
  double fill = 0.5;
  int max_branches = 4;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.eccentricity, plain("eccentricity", 0, 1,
                                   "Eccentricity below which a node is in a junction (delta_e)."));
    visit(self.range, plain("range", 0.1, 10, "Reach of a node, in channel widths."));
    visit(self.arms, plain("arms", 0, 10, "Minimum number of channels in a junction."));
    visit(self.arm_gap, deg("arm_gap", 0, 120, "Minimum angle between two channels."));
    visit(self.merge_distance,
          plain("merge_distance", 0, 10, "Distance below which junction nodes are one junction."));
    visit(self.fill, plain("fill", 0, 1, "Share of junction nodes in a junction's middle."));
    visit(self.max_branches, plain("max_branches", 1, 10, "Maximum number of branches of a region.")
                                 .formerly("most_branches"));
  }
};

}  // namespace microswarm::planning
