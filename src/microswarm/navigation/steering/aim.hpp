// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/infinity.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm {

/// Share of a goal's tolerance within which it is headed for: the rest is for following a path.
inline constexpr double aim_share = 0.9;

/// The point that a swarm heads for when it must stay `clearance` [µm] away from `walls`: the goal,
/// or about the nearest free point within `aim_share` of the tolerance [µm] of it, so that it gets
/// there although it does not keep to a point exactly. Nothing when there is none. The check of a
/// scenario and the navigators ask here, so what passes the one is what the others head for.
std::optional<Vec2> reachable_goal(const Snapshot& walls, Vec2 goal, double tolerance,
                                   double clearance);

/// The point that a swarm heads for: the goal, or a point within its tolerance.
struct Aim {
  Vec2 position;                ///< [µm]
  double clearance = infinity;  ///< of it, to walls [µm]
  double tolerance = 0;         ///< what it leaves of the goal's [µm]

  /// How far to stay from walls [µm] on the next `reach` µm from `p`: `wanted`; where they come
  /// near to an aim that has less, its clearance, but `least` at least.
  double wall_clearance(double least, double wanted, Vec2 p, double reach) const;
};

/// An aim with `wanted` clearance from `walls`. Where that is too much, half of what can be had
/// besides `least` is kept: a swarm strays from its path, and has some room to the walls and in the
/// tolerance. The goal itself when no point keeps `least`.
Aim aim_at(const Snapshot& walls, Vec2 goal, double tolerance, double least, double wanted);

}  // namespace microswarm
