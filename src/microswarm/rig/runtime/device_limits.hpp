// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm::rig {

/// Detects a device whose own limits leave almost no current, so that the commanded field is
/// absent.
class DeviceLimits {
 public:
  static constexpr double min_scale = 0.1;  ///< minimum of CoilOutput::device_scale
  static constexpr double longest = 1;      ///< longest time below the minimum [s]

  /// Takes an output at `t` [s]. Returns why it is a fault, or an empty string.
  std::string take(double t, const actuation::CoilOutput& output) {
    if (output.device_scale >= min_scale) {
      since_ = infinity;
      return {};
    }
    since_ = std::min(since_, t);
    if (t - since_ <= longest) return {};
    if (output.device_scale == 0) return "the device drives no current";
    return fmt::format("the device drives {:.3g} % of the currents", 100 * output.device_scale);
  }

 private:
  double since_ = infinity;  // start of the time below the minimum [s]
};

}  // namespace microswarm::rig
