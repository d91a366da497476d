// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/observation.hpp"
#include "microswarm/core/execution/lazy.hpp"
#include "microswarm/core/execution/status.hpp"
#include "microswarm/experiment/monitors/contact_monitor.hpp"
#include "microswarm/experiment/results/frame.hpp"

namespace microswarm::experiment {

/// One tick of an episode: the state at its start and what happened during it. Valid until the next
/// one.
struct Tick {
  Frame frame{};
  NavigatorView view{};             ///< of the navigator; empty for the last tick
  Lazy<Diagnostics> diagnostics{};  ///< of the navigator; in the last tick those of its last step
  const Snapshot* world = nullptr;  ///< at the frame's time
  /// Positions of individually tracked robots at the frame's time [µm].
  std::optional<std::span<const Vec2>> robots{};
  /// Changes since the last tick, such as "navigator.speed_um_per_s=60", in order.
  std::span<const std::string> changes{};
  std::span<const RunEvent> events{};
  std::span<const PoseStamped> trajectory{};  ///< path of the swarm during the tick, if known
  const ContactMonitor* contacts = nullptr;   ///< up to the tick's end; null if unknown
  bool holding = false;         ///< the goal was reached before, and the swarm is held there
  bool detects = false;         ///< an obstacle is in the detection circle of Eq 3 [radar]
  double step_time = 0;         ///< wall-clock time of the navigator's step [s]
  std::optional<Status> end{};  ///< set for the last tick, which has only a frame
  std::string_view fault{};     ///< why the plant stopped; set for the last tick
};

}  // namespace microswarm::experiment
