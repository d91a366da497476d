// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace microswarm {

/// What a navigator does in a step.
enum class NavigatorState {
  hold,      ///< no move is safe
  follow,    ///< on its way
  fallback,  ///< the same by pure pursuit: the learned follower does not know
  avoid,     ///< round an obstacle
  direct,    ///< straight to the target: no obstacle is detected
  escape,    ///< the least bad move: none is safe
  retreat,   ///< away from an obstacle
  guard,     ///< the safety filter's command instead of its own
  wait,      ///< for a valve to open
  stuck,     ///< it finds no way
  play,      ///< the plan's inputs
  rejoin,    ///< back to the plan
  replan,    ///< a new plan
  gather,    ///< robots towards the goal
  arrived,   ///< at the goal
  blind,     ///< it sees no swarm, or too late
  end        ///< of a record's last frame: the run is over
};
constexpr auto enum_names(NavigatorState) {
  return std::array<std::pair<NavigatorState, std::string_view>, 17>{
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
       {NavigatorState::end, "end"}}};
}

}  // namespace microswarm
