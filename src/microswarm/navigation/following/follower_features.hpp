// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "microswarm/navigation/following/follower.hpp"

namespace microswarm {

/// What a learned follower goes by.
struct FollowerQuery {
  std::span<const Vec2> path;
  PathPlace place;           ///< nearest to the swarm
  Pose2 pose;                ///< where the swarm will be when the command takes effect
  double speed = 0;          ///< asked for [µm/s]
  Vec2 flow;                 ///< that carries the swarm, as far as is known [µm/s]
  double max_turn_rate = 0;  ///< [rad/s]; may be infinite
};

/// How far ahead the path is looked at, in seconds at the speed asked for.
inline constexpr std::array<double, 7> preview_times{0, 0.15, 0.3, 0.5, 0.8, 1.2, 1.8};
/// The one that gives the bearing.
inline constexpr std::size_t bearing_preview = 3;
/// Two for each point of the path ahead but the bearing's, which has one; two for the heading, two
/// for the flow, one for the turning limit.
inline constexpr std::size_t feature_count = 2 * preview_times.size() - 1 + 5;

/// The query as a network takes it: without units, and turned so that the bearing is the x axis.
/// The unit of length is the way of one second at the speed asked for.
struct FollowerFeatures {
  double bearing = 0;  ///< direction of the point of the path 0.5 s ahead [rad]
  std::array<double, feature_count> features{};
};
FollowerFeatures features_of(const FollowerQuery& query);

}  // namespace microswarm
