// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "microswarm/navigation/following/follower.hpp"

namespace microswarm::navigation {

/// Inputs of a learned follower.
struct FollowerQuery {
  std::span<const Vec2> path{};
  PathPosition position{};   ///< position nearest to the swarm
  Pose2 pose{};              ///< pose at which the command takes effect
  double speed = 0;          ///< commanded [µm/s]
  Vec2 flow{};               ///< estimated drift of the swarm [µm/s]
  double max_turn_rate = 0;  ///< [rad/s]; may be infinite
};

/// Preview times along the path, in seconds at the commanded speed.
inline constexpr std::array<double, 7> preview_times{0, 0.15, 0.3, 0.5, 0.8, 1.2, 1.8};
/// Index of the preview time that defines the bearing.
inline constexpr std::size_t bearing_preview = 3;
/// Two features for each preview point, except one for the bearing's; two for the heading, two for
/// the flow, one for the turning limit.
inline constexpr std::size_t feature_count = 2 * preview_times.size() - 1 + 5;

/// Dimensionless network inputs of a query, rotated so that the bearing is the x axis. The unit of
/// length is the distance covered in one second at the commanded speed.
struct FollowerFeatures {
  double bearing = 0;  ///< direction of the path point 0.5 s ahead [rad]
  std::array<double, feature_count> features{};
};
FollowerFeatures to_features(const FollowerQuery& query);

}  // namespace microswarm::navigation
