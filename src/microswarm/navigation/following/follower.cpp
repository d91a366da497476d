// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/follower.hpp"

#include <algorithm>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

double projected_share(Segment s, Vec2 p) {
  const Vec2 along = s.b - s.a;
  const double length2 = squared_norm(along);
  return length2 > 0 ? std::clamp(dot(p - s.a, along) / length2, 0.0, 1.0) : 1.0;
}

}  // namespace

PathPosition nearest_position(std::span<const Vec2> path, Vec2 p, PathPosition from) {
  PathPosition best = from;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = from.piece; i + 1 < path.size(); ++i) {
    double share = projected_share({path[i], path[i + 1]}, p);
    if (i == from.piece) share = std::max(share, from.share);
    const double d = distance(p, path[i] + share * (path[i + 1] - path[i]));
    if (d < best_distance) {
      best_distance = d;
      best = {i, share};
    }
  }
  return best;
}

Vec2 point_ahead(std::span<const Vec2> path, PathPosition position, double ahead) {
  for (std::size_t i = position.piece; i + 1 < path.size(); ++i) {
    const double length = distance(path[i], path[i + 1]);
    const double start = i == position.piece ? position.share * length : 0;
    if (start + ahead <= length && length > 0)
      return path[i] + ((start + ahead) / length) * (path[i + 1] - path[i]);
    ahead -= length - start;
  }
  return path.back();
}

double remaining(std::span<const Vec2> path, PathPosition position) {
  double left = 0;
  for (std::size_t i = position.piece; i + 1 < path.size(); ++i) {
    const double length = distance(path[i], path[i + 1]);
    left += i == position.piece ? (1 - position.share) * length : length;
  }
  return left;
}

Command pursue(std::span<const Vec2> path, PathPosition& position, const Pose2& pose,
               double lookahead, double speed) {
  position = nearest_position(path, pose.position, position);
  const Vec2 to = point_ahead(path, position, lookahead) - pose.position;
  const double heading = squared_norm(to) > 0 ? heading_along(to) : pose.heading;
  const double off = turn_between(heading, pose.heading);
  const double ease = off > pi / 2 ? 0.25 : 1.0;
  return {heading, ease * speed};
}

}  // namespace microswarm::navigation
