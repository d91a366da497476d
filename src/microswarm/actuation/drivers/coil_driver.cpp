// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/coil_driver.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm {

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

std::string trouble_of(const CoilDriver& driver, DriveStatus status) {
  std::string trouble(status == DriveStatus::no_answer ? "the coil driver does not answer"
                                                       : trouble_of(status));
  const std::string reason = trouble.empty() ? std::string() : driver.reason();
  return reason.empty() ? trouble : trouble + ": " + reason;
}

DriveStatus CoilDriver::drive_field(std::span<const double, 3>, std::span<const double> currents) {
  return drive(currents);
}

double CurrentWaveform::largest(std::size_t channel) const {
  const double along = cosine[channel], across = sine[channel];
  return std::abs(constant[channel]) + std::sqrt(along * along + across * across);
}

SimulatedCoilDriver::SimulatedCoilDriver(int channels, double full_scale, bool waveforms)
    : currents_(static_cast<std::size_t>(channels)),
      full_scale_(full_scale),
      waveforms_(waveforms) {}

DriveStatus SimulatedCoilDriver::drive(std::span<const double> currents) {
  assert(currents.size() == currents_.size());
  const bool possible = std::all_of(currents.begin(), currents.end(), [&](double i) {
    return std::abs(i) <= full_scale_ * (1 + full_scale_slack);
  });
  if (!possible) return DriveStatus::refused;
  std::copy(currents.begin(), currents.end(), currents_.begin());
  phase_.reset();
  return DriveStatus::driven;
}

DriveStatus SimulatedCoilDriver::drive_waveform(const CurrentWaveform& waveform) {
  const auto [sine, cosine] = maths::sincos(waveform.phase);
  for (std::size_t c = 0; c < currents_.size(); ++c) {
    if (!(waveform.largest(c) <= full_scale_ * (1 + full_scale_slack))) return DriveStatus::refused;
    currents_[c] = waveform.constant[c] + waveform.cosine[c] * cosine + waveform.sine[c] * sine;
  }
  phase_ = waveform.phase;
  return DriveStatus::driven;
}

StopReport SimulatedCoilDriver::stop() noexcept {
  std::fill(currents_.begin(), currents_.end(), 0.0);
  phase_.reset();
  return {.confirmed = true};
}

}  // namespace microswarm
