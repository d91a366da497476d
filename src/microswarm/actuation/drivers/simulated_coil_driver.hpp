// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm::actuation {

/// Simulated coils that accept any current up to the full scale.
struct SimulatedCoils {
  static constexpr std::string_view type_name = "simulated";
  static constexpr bool is_device = false;
  int channels = 6;
  double full_scale = 20;
  bool waveforms = false;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.channels, plain("channels", 1, 64, "Number of coil channels."));
    visit(self.full_scale, a("full_scale", 1e-6, 1e6, "Current of a channel at full output."));
    visit(self.waveforms, plain("waveforms", "The coils turn the field; the host only steers it."));
  }
  CoilInput input() const { return waveforms ? CoilInput::waveform : CoilInput::currents; }
  int channel_count(std::size_t) const { return channels; }
  Issues validate(double) const { return {}; }
  std::unique_ptr<CoilDriver> open(const CoilSite& site) const;
};

/// Driver without hardware. It takes requests of all kinds; a waveform has the commanded phase.
class SimulatedCoilDriver final : public CoilDriver {
 public:
  /// `full_scale` is the maximum current [A].
  SimulatedCoilDriver(int channels, double full_scale, CoilInput input = CoilInput::currents);

  Capabilities capabilities() const override { return capabilities_; }
  DriveStatus drive(const CoilRequest& request) override;
  const DeviceReport& report() const override { return report_; }
  StopReport stop() noexcept override;

 private:
  DriveStatus hold(std::span<const double> currents);
  DriveStatus turn(const CurrentWaveform& waveform);

  Capabilities capabilities_;
  double full_scale_;
  DeviceReport report_;
};

}  // namespace microswarm::actuation
