// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/navigator_state.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/contracts/plan.hpp"

namespace microswarm {

/// What a navigator did in its last step, for records and pictures.
struct NavigatorView {
  bool planned = false;  ///< it called a planner in this step: a planning event
  NavigatorState state = NavigatorState::hold;
  std::optional<Vec2> local_target;  ///< where it heads for now
  /// The waypoint that it would head for were there no obstacles: v_t of Eq 3 [radar] points there.
  /// Nothing for the goal.
  std::optional<Vec2> phased_goal{};
  std::span<const Vec2> path;  ///< the path it follows
  const Plan* plan = nullptr;  ///< the newest plan with its tree; null before the first
};

/// Turns one observation into one command and keeps what it needs in between. It knows no clock:
/// time comes with the observation. It never moves on when unsure: no swarm seen, a stale frame or
/// no safe move is a hold.
class Navigator {
 public:
  virtual ~Navigator() = default;
  /// Called once before the first step with the world as it is then; what takes long belongs here.
  virtual void prepare(const Snapshot&) {}
  virtual Command step(const Observation& observation, const Stop& stop) = 0;
  /// Valid until the next step.
  virtual NavigatorView view() const = 0;
};

}  // namespace microswarm
