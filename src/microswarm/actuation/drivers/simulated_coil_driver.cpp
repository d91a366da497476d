// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/simulated_coil_driver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::actuation {

std::unique_ptr<CoilDriver> SimulatedCoils::open(const CoilSite&) const {
  return std::make_unique<SimulatedCoilDriver>(channels, full_scale, input());
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
