// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/following/follower_params.hpp"

namespace microswarm::navigation {

/// Follows a given path and stops while something is in the way: for comparing followers, and for
/// paths drawn by hand.
struct PathNavigatorParams {
  static constexpr std::string_view type_name = "follow_path";
  std::vector<Vec2> path{};
  double speed = 60;
  double lookahead = 20;
  FollowerParams follower{};
  double horizon = 1;
  double gap = 10;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.path, um("path", "Points of the path without the goal; none: straight."));
    visit(self.speed, um_per_s("speed", 1e-3, 1e5, "Commanded speed."));
    visit(self.lookahead, um("lookahead", 1e-3, 1e5, "Lookahead distance of pure pursuit."));
    visit(self.follower, plain("follower", "Path follower."));
    visit(self.horizon, s("horizon", 0.1, 10, "Hold if the path is blocked within this time."));
    visit(self.gap, um("gap", 0, 1e5, "Gap kept around the swarm.").formerly("margin_um"));
  }
};

}  // namespace microswarm::navigation
