// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace microswarm {

/// Relative tolerance for currents above the full scale, for rounding.
inline constexpr double full_scale_slack = 1e-9;

/// Commands in a row without an answer at which a driver counts as gone.
inline constexpr int max_missed_answers = 3;

/// Result of a command to the coils.
enum class DriveStatus : std::uint8_t {
  driven,
  scaled,      ///< the device's own limits scaled all currents by the same factor
  resumed,     ///< driven, but the coils had been off: the device restarted or its watchdog fired
  refused,     ///< more current than the driver can request; the coils keep their currents
  not_armed,   ///< the device is off and refuses to be armed, or may only be armed by a person
  emergency,   ///< the emergency stop of the device is or was open
  mismatched,  ///< the device acknowledges or reports something else than it was told
  no_answer,   ///< the coils switch off within the device's watchdog time, or the device is gone
};
std::string_view to_string(DriveStatus status);
/// Why such a status ends a run, in words; empty if it does not by itself.
std::string_view trouble_of(DriveStatus status);

/// Interface that sends currents to coils. The destructor sets all currents to zero.
class CoilDriver {
 public:
  CoilDriver() = default;
  CoilDriver(const CoilDriver&) = delete;
  CoilDriver& operator=(const CoilDriver&) = delete;
  virtual ~CoilDriver() = default;

  virtual int channels() const = 0;
  /// Currents of the coils as last reported by the device [A].
  virtual std::span<const double> currents() const = 0;
  /// Sends signed currents [A], one per channel. Must be repeated within the watchdog time, even if
  /// unchanged.
  virtual DriveStatus drive(std::span<const double> currents) = 0;
  /// Sets all currents to zero; false if the device did not confirm it.
  virtual bool stop() noexcept = 0;
  /// Lets a `drive` that another thread is in return without its answer, so that `stop` can follow.
  /// Callable from any thread; lasts until the next `stop`.
  virtual void interrupt() noexcept {}
};

/// Driver without hardware.
class SimulatedCoilDriver final : public CoilDriver {
 public:
  /// `full_scale` is the maximum current [A].
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
