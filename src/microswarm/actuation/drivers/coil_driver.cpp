// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/coil_driver.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/maths.hpp"

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

SimulatedCoilDriver::SimulatedCoilDriver(int channels, double full_scale, CoilInput input)
    : capabilities_{channels, input},
      full_scale_(full_scale),
      report_{.currents = std::vector<double>(static_cast<std::size_t>(channels))} {}

DriveStatus SimulatedCoilDriver::drive(const CoilRequest& request) {
  return std::visit(Overloaded{[&](std::span<const double> currents) { return hold(currents); },
                               [&](const FieldRequest& field) { return hold(field.currents); },
                               [&](const CurrentWaveform& waveform) { return turn(waveform); }},
                    request);
}

DriveStatus SimulatedCoilDriver::hold(std::span<const double> currents) {
  assert(currents.size() == report_.currents.size());
  const bool possible = std::ranges::all_of(
      currents, [&](double i) { return std::abs(i) <= full_scale_ * (1 + full_scale_slack); });
  if (!possible) return DriveStatus::refused;
  std::ranges::copy(currents, report_.currents.begin());
  report_.phase.reset();
  return DriveStatus::driven;
}

DriveStatus SimulatedCoilDriver::turn(const CurrentWaveform& waveform) {
  const auto [sine, cosine] = maths::sincos(waveform.phase);
  for (std::size_t c = 0; c < report_.currents.size(); ++c) {
    if (!(waveform.largest(c) <= full_scale_ * (1 + full_scale_slack))) return DriveStatus::refused;
    report_.currents[c] =
        waveform.constant[c] + waveform.cosine[c] * cosine + waveform.sine[c] * sine;
  }
  report_.phase = waveform.phase;
  return DriveStatus::driven;
}

StopReport SimulatedCoilDriver::stop() noexcept {
  std::ranges::fill(report_.currents, 0.0);
  report_.phase.reset();
  return {.confirmed = true};
}

}  // namespace microswarm::actuation
