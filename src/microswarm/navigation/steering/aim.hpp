// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::navigation {

/// Fraction of the goal's tolerance used to choose the aim; the rest is for path-following errors.
inline constexpr double aim_share = 0.9;

/// Point that a swarm heads for if it must keep `clearance` [µm] from `walls`: the goal, or
/// approximately the nearest free point within `aim_share` of the tolerance [µm], so that it
/// arrives even though it does not reach a point exactly. Nothing if there is none. Used by the
/// scenario check and by the navigators, so that both agree.
std::optional<Vec2> reachable_goal(const Snapshot& walls, Vec2 goal, double tolerance,
                                   double clearance);

/// Target point of a swarm: the goal, or a point within its tolerance.
struct Aim {
  Vec2 position{};              ///< [µm]
  double clearance = infinity;  ///< distance to walls [µm]
  double tolerance = 0;         ///< tolerance left around it [µm]

  /// Clearance from walls [µm] to keep on the next `reach` µm from `p`: `wanted`. If walls are near
  /// an aim that has less clearance, the aim's clearance, but at least `least`.
  double wall_clearance(double least, double wanted, Vec2 p, double reach) const;
};

/// Aim with `wanted` clearance from `walls`. If that is impossible, with half of the possible
/// clearance beyond `least`, since a swarm deviates from its path and needs some room to the walls
/// and in the tolerance. The goal itself if no point has `least`.
Aim aim_at(const Snapshot& walls, Vec2 goal, double tolerance, double least, double wanted);

}  // namespace microswarm::navigation
