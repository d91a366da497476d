// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/core/status.hpp"
#include "microswarm/experiment/run/contact_monitor.hpp"
#include "microswarm/experiment/run/frame.hpp"

namespace microswarm {

/// One tick of an episode: what it was like when it began, and what happened in it. Valid until the
/// next one.
struct Tick {
  Frame frame;
  NavigatorView view;               ///< what the navigator did; of the end nothing
  const Snapshot* world = nullptr;  ///< at the frame's time
  /// Positions at the frame's time [µm] of robots that are tracked one by one.
  std::optional<std::span<const Vec2>> robots;
  /// What was changed since the last tick, "navigator.speed_um_per_s=60", in its order.
  std::span<const std::string> changes;
  std::span<const RunEvent> events;
  std::span<const PoseStamped> trajectory;   ///< the swarm's way in the tick, where it is known
  const ContactMonitor* contacts = nullptr;  ///< up to the tick's end; null where nobody knows
  double step_time = 0;                      ///< wall-clock time of the navigator's step [s]
  std::optional<Status> end;                 ///< of the last tick, which has only a frame
  std::string_view fault;                    ///< why the plant could not go on; of the last tick
};

}  // namespace microswarm
