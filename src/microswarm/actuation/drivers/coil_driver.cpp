// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/coil_driver.hpp"

#include <array>
#include <cassert>
#include <cmath>

namespace microswarm::actuation {

std::string_view to_string(DriveStatus status) {
  constexpr std::array<std::string_view, 9> names{"driven",     "scaled",    "resumed",
                                                  "refused",    "not_armed", "emergency",
                                                  "mismatched", "no_answer", "gone"};
  return names[static_cast<std::size_t>(status)];
}

bool is_acknowledged(DriveStatus status) {
  return status == DriveStatus::driven || status == DriveStatus::scaled ||
         status == DriveStatus::resumed;
}

std::string_view trouble_text(DriveStatus status) {
  switch (status) {
    case DriveStatus::refused:
      return "the coil driver refuses the currents";
    case DriveStatus::not_armed:
      return "the coils' device is off and does not let itself be armed";
    case DriveStatus::emergency:
      return "the emergency stop of the coils' device was pressed";
    case DriveStatus::mismatched:
      return "the coils' device reports other values than those sent";
    case DriveStatus::gone:
      return "the coil driver has ended";
    case DriveStatus::driven:
    case DriveStatus::scaled:
    case DriveStatus::resumed:
    case DriveStatus::no_answer:
      return {};
  }
  assert(false);
  return {};
}

std::string trouble_text(const CoilDriver& driver, DriveStatus status) {
  std::string trouble(status == DriveStatus::no_answer ? "the coil driver does not answer"
                                                       : trouble_text(status));
  const std::string reason = trouble.empty() ? std::string() : driver.report().reason;
  return reason.empty() ? trouble : trouble + ": " + reason;
}

double CurrentWaveform::largest(std::size_t channel) const {
  const double along = cosine[channel], across = sine[channel];
  return std::abs(constant[channel]) + std::sqrt(along * along + across * across);
}

CoilRequest constant_request(const Capabilities& device, std::span<const double, 3> field,
                             std::span<const double> currents) {
  if (device.input == CoilInput::field) return FieldRequest{field, currents};
  return currents;
}

}  // namespace microswarm::actuation
