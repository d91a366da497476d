// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace microswarm {

/// State of a navigator in a step.
enum class NavigatorState {
  hold,      ///< no move is safe
  follow,    ///< follows the path
  fallback,  ///< follows the path by pure pursuit, because the learned follower is not applicable
  avoid,     ///< goes around an obstacle
  direct,    ///< straight to the target: no obstacle detected
  escape,    ///< least unsafe move: none is safe
  retreat,   ///< moves away from an obstacle
  guard,     ///< the safety filter replaced the command
  wait,      ///< waits for a valve to open
  stuck,     ///< finds no path
  play,      ///< executes the plan's inputs
  rejoin,    ///< returns to the plan
  replan,    ///< made a new plan
  gather,    ///< moves robots towards the goal
  arrived,   ///< at the goal
  blind,     ///< no swarm detected, or the frame is stale
  paused,    ///< a person paused the experiment: hold
  manual,    ///< a person steers
  // No navigator returns it: the hash of every record covers this word in the last frame.
  end  ///< last frame of a record: the run is over
};
constexpr auto enum_names(NavigatorState) {
  return std::array<std::pair<NavigatorState, std::string_view>, 19>{
      {{NavigatorState::hold, "hold"},
       {NavigatorState::follow, "follow"},
       {NavigatorState::fallback, "fallback"},
       {NavigatorState::avoid, "avoid"},
       {NavigatorState::direct, "direct"},
       {NavigatorState::escape, "escape"},
       {NavigatorState::retreat, "retreat"},
       {NavigatorState::guard, "guard"},
       {NavigatorState::wait, "wait"},
       {NavigatorState::stuck, "stuck"},
       {NavigatorState::play, "play"},
       {NavigatorState::rejoin, "rejoin"},
       {NavigatorState::replan, "replan"},
       {NavigatorState::gather, "gather"},
       {NavigatorState::arrived, "arrived"},
       {NavigatorState::blind, "blind"},
       {NavigatorState::paused, "paused"},
       {NavigatorState::manual, "manual"},
       {NavigatorState::end, "end"}}};
}

}  // namespace microswarm
