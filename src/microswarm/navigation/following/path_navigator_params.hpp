// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "microswarm/core/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/following/follower_params.hpp"

namespace microswarm {

/// Follows a path that is given, and stops while something stands in the way: for comparing
/// followers, and for paths drawn by hand.
struct PathNavigatorParams {
  static constexpr std::string_view type_name = "follow_path";
  std::vector<Vec2> path;
  double speed = 60;
  double lookahead = 20;
  FollowerParams follower;
  double horizon = 1;
  double gap = 10;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.path,
          {"path", Unit::um, {}, "Its points but the last, the goal; none: straight there."});
    visit(self.speed, {"speed", Unit::um_per_s, {1e-3, 1e5}, "Speed asked for."});
    visit(self.lookahead,
          {"lookahead", Unit::um, {1e-3, 1e5}, "How far ahead pure pursuit pursues the path."});
    visit(self.follower, {"follower", Unit::none, {}, "Who follows the path."});
    visit(self.horizon,
          {"horizon", Unit::s, {0.1, 10}, "Hold when something stands in the way of so long."});
    visit(self.gap, {"margin", Unit::um, {0, 1e5}, "Kept beside the swarm's edge."});
  }
};

}  // namespace microswarm
