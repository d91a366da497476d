// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/navigation/following/follower.hpp"

namespace microswarm::navigation {

/// A path that is followed, and for what it was planned.
struct FollowedPath {
  enum class Kind {
    local,    ///< to a local target among obstacles as they are
    in_time,  ///< to one among predicted obstacles
    route     ///< the shortest to the aim among walls
  };

  std::vector<Vec2> points{};  ///< fewer than two: no path
  PathPosition position{};     ///< on it
  Kind kind = Kind::local;
  double clearance = 0;        ///< from walls and obstacles [µm]
  double route_clearance = 0;  ///< of the route, if it is one [µm]
  double lookahead_share = 1;  ///< of the look-ahead with which it is followed

  explicit operator bool() const { return points.size() >= 2; }
  bool is_route() const { return kind == Kind::route; }
  /// The part that remains.
  std::vector<Vec2> rest() const {
    std::vector<Vec2> out{point_ahead(points, position, 0)};
    out.insert(out.end(), points.begin() + static_cast<std::ptrdiff_t>(position.piece) + 1,
               points.end());
    return out;
  }
};

}  // namespace microswarm::navigation
