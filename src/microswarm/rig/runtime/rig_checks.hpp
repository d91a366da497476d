// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/execution/durations.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm::rig {

/// Result of one check of a rig.
struct RigCheck {
  std::string what{};
  bool good = true;
  std::string answer{};
  bool required = true;  ///< whether a run is refused if the check fails
};

/// Checks whether the coils can hold the rig's field in every direction, from ambient temperature.
RigCheck check_field(const Rig& rig);

/// Throws InputError if `check_field` fails.
void require_field(const Rig& rig);

/// Reports the limits that are missing in a coil system driven by a real device.
Issues missing_limits(const Rig& rig);

/// Observes the rig's camera for `seconds`: its state, and the time between frames beside the rate
/// that the rig file asks for, or otherwise `rate`, that of the camera's driver [Hz].
std::vector<RigCheck> check_camera(vision::NewestFrame& camera, const Rig& rig,
                                   std::optional<double> rate, double seconds,
                                   const Stop& stop = {});

/// Sends zero currents to the device for `seconds`, at the rig's `drive_rate`, then stops it.
/// Missed answers are borne as in a run.
std::vector<RigCheck> check_driver(actuation::CoilDriver& driver, const Rig& rig, double seconds,
                                   const Stop& stop = {});

/// Measures for `seconds` by how much the thread of the coils would be late at the rig's
/// `drive_rate` and `realtime_priority`.
RigCheck check_computer(const Rig& rig, double seconds, const Stop& stop = {});

/// Quantiles of durations as "p50 / p95 / p99 ms", "–" if there are none.
std::string quantiles(const Durations& times);

}  // namespace microswarm::rig
