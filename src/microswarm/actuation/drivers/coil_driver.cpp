// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/coil_driver.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace microswarm {

std::string_view to_string(DriveStatus status) {
  constexpr std::array<std::string_view, 8> names{"driven",     "scaled",    "resumed",
                                                  "refused",    "not_armed", "emergency",
                                                  "mismatched", "no_answer"};
  return names[static_cast<std::size_t>(status)];
}

std::string_view trouble_of(DriveStatus status) {
  switch (status) {
    case DriveStatus::refused:
      return "the coil driver refuses the currents";
    case DriveStatus::not_armed:
      return "the coils' device is off and does not let itself be armed";
    case DriveStatus::emergency:
      return "the emergency stop of the coils' device was pressed";
    case DriveStatus::mismatched:
      return "the coils' device does something else than it was told";
    case DriveStatus::driven:
    case DriveStatus::scaled:
    case DriveStatus::resumed:
    case DriveStatus::no_answer:
      return {};
  }
  assert(false);
  return {};
}

SimulatedCoilDriver::SimulatedCoilDriver(int channels, double full_scale)
    : currents_(static_cast<std::size_t>(channels)), full_scale_(full_scale) {}

DriveStatus SimulatedCoilDriver::drive(std::span<const double> currents) {
  assert(currents.size() == currents_.size());
  const bool possible = std::all_of(currents.begin(), currents.end(), [&](double i) {
    return std::abs(i) <= full_scale_ * (1 + full_scale_slack);
  });
  if (!possible) return DriveStatus::refused;
  std::copy(currents.begin(), currents.end(), currents_.begin());
  return DriveStatus::driven;
}

bool SimulatedCoilDriver::stop() noexcept {
  std::fill(currents_.begin(), currents_.end(), 0.0);
  return true;
}

}  // namespace microswarm
