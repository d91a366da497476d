// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/contracts/navigator_state.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/contracts/plan.hpp"

namespace microswarm {

/// Navigator's last step, for records and pictures.
struct NavigatorView {
  bool planned = false;  ///< whether it called a planner in this step: a planning event
  NavigatorState state = NavigatorState::hold;
  std::optional<Vec2> local_target{};  ///< current target
  /// Waypoint it would head for without obstacles: v_t of Eq 3 [radar] points there. Nothing if
  /// that is the goal.
  std::optional<Vec2> phased_goal{};
  std::span<const Vec2> path{};  ///< path being followed
  const Plan* plan = nullptr;    ///< latest plan with its tree; null before the first
};

/// Turns one observation into one command and keeps its own state between steps. It has no clock:
/// time comes with the observation. It holds if it is unsure: no swarm detected, a stale frame or
/// no safe move.
class Navigator {
 public:
  virtual ~Navigator() = default;
  /// Called once before the first step with the initial world; do slow preparation here. If `stop`
  /// ends it, no step follows.
  virtual void prepare(const Snapshot& world, const Stop& stop) { (void)world, (void)stop; }
  virtual Command step(const Observation& observation, const Stop& stop) = 0;
  /// Another command was given in place of a step at `now` [s], because the experiment is paused or
  /// steered by hand.
  virtual void overruled(double now, const Command& command) { (void)now, (void)command; }
  /// Valid until the next step.
  virtual NavigatorView view() const = 0;
  /// Diagnostics of the last step, computed on request, which may take longer than the step. Call
  /// it before the next step.
  virtual Diagnostics diagnostics() const { return {}; }
};

}  // namespace microswarm
