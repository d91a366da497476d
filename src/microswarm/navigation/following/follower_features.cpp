// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/follower_features.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {

FollowerFeatures to_features(const FollowerQuery& query) {
  const Vec2 from = query.pose.position;
  const auto ahead = [&](std::size_t k) {
    return point_ahead(query.path, query.position, preview_times[k] * query.speed) - from;
  };
  const Vec2 to = ahead(bearing_preview);
  FollowerFeatures features{.bearing =
                                squared_norm(to) > 0 ? heading_along(to) : query.pose.heading};
  const Vec2 x = unit_vector(features.bearing);
  const Vec2 y{-x.y, x.x};
  auto feature = features.features.begin();
  const auto add = [&](double value) { *feature++ = value; };
  for (std::size_t k = 0; k < preview_times.size(); ++k) {
    const Vec2 point = (1 / query.speed) * ahead(k);
    add(dot(point, x));
    if (k != bearing_preview) add(dot(point, y));  // the bearing's own component is 0
  }
  const double off = wrap(query.pose.heading - features.bearing);
  const auto [sine, cosine] = maths::sincos(off);
  add(sine);
  add(cosine);
  const Vec2 flow = (1 / query.speed) * query.flow;
  add(dot(flow, x));
  add(dot(flow, y));
  add(1 / query.max_turn_rate);
  return features;
}

}  // namespace microswarm::navigation
