// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace microswarm {

/// Share of the full scale by which currents may exceed it, for rounding.
inline constexpr double full_scale_slack = 1e-9;

/// What became of a command to the coils.
enum class DriveStatus : std::uint8_t {
  driven,
  scaled,     ///< the device's own limits made all currents smaller by the same factor
  resumed,    ///< driven, but the coils had been off: the device restarted or its watchdog struck
  refused,    ///< more current than the driver can be asked for; the coils are as before
  not_armed,  ///< the device is off and does not let itself be armed
  no_answer,  ///< the coils are off within the device's watchdog time, or it is gone
};
std::string_view to_string(DriveStatus status);

/// Sends currents to coils. Whoever destroys one leaves the coils without current.
class CoilDriver {
 public:
  CoilDriver() = default;
  CoilDriver(const CoilDriver&) = delete;
  CoilDriver& operator=(const CoilDriver&) = delete;
  virtual ~CoilDriver() = default;

  virtual int channels() const = 0;
  /// Currents [A] that the coils have, as far as the device told last.
  virtual std::span<const double> currents() const = 0;
  /// Currents [A], one a channel, signed. To be repeated within the watchdog time, changed or not.
  virtual DriveStatus drive(std::span<const double> currents) = 0;
  /// All currents to zero; false when the device did not confirm it.
  virtual bool stop() noexcept = 0;
};

/// Coils that are not there.
class SimulatedCoilDriver final : public CoilDriver {
 public:
  /// `full_scale` is the largest current [A].
  SimulatedCoilDriver(int channels, double full_scale);

  int channels() const override { return static_cast<int>(currents_.size()); }
  DriveStatus drive(std::span<const double> currents) override;
  bool stop() noexcept override;
  std::span<const double> currents() const override { return currents_; }

 private:
  std::vector<double> currents_;
  double full_scale_;
};

}  // namespace microswarm
