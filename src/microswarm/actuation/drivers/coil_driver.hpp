// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// Relative tolerance for currents above the full scale, for rounding.
inline constexpr double full_scale_slack = 1e-9;

/// Consecutive commands without an answer after which a driver counts as gone.
inline constexpr int max_missed_answers = 3;

/// Result of a command to the coils.
enum class DriveStatus : std::uint8_t {
  driven,
  scaled,      ///< the device's own limits scaled all currents by the same factor
  resumed,     ///< driven after the coils were off: the device restarted or its watchdog fired
  refused,     ///< more current than the driver can request; the coils keep their currents
  not_armed,   ///< the device is off and refuses to be armed, or only a person may arm it
  emergency,   ///< the emergency stop of the device is or was open
  mismatched,  ///< the device acknowledges or reports other values than those sent
  no_answer,   ///< the coils switch off within the device's watchdog time, or the device is gone
  gone,        ///< the driver's program or connection has ended
};
std::string_view to_string(DriveStatus status);
/// Whether the device acknowledged the command.
bool is_acknowledged(DriveStatus status);
/// Why this status ends a run, as text; empty if it does not by itself.
std::string_view trouble_of(DriveStatus status);

/// Currents that the device turns by itself: constant + cosine cos φ + sine sin φ [A], one of each
/// per channel, with a phase φ that turns at `frequency` [Hz].
struct CurrentWaveform {
  double frequency = 0;  ///< [Hz], negative backwards
  double phase = 0;      ///< of a starting waveform [rad]; a running one keeps its own
  std::span<const double> constant, cosine, sine;

  /// Peak current of a channel within a turn [A].
  double largest(std::size_t channel) const;
};

/// Result of setting all currents to zero.
struct StopReport {
  bool confirmed = false;  ///< whether the device confirmed zero currents
  double at = 0;           ///< time after the command of zero [s], by steady_seconds()
  std::string trouble{};  ///< why a fallback driver confirmed it, as text that follows the driver's
                          ///< name; empty if the active one did

  /// Whether the driver that drove confirmed it.
  bool good() const { return confirmed && trouble.empty(); }
};

class CoilDriver;
/// The same with the driver's own reason, CoilDriver::reason; also for no_answer.
std::string trouble_of(const CoilDriver& driver, DriveStatus status);

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
  /// Factor by which the device's own limits scaled the last acknowledged command, in [0, 1].
  virtual double device_scale() const { return 1; }
  /// Sends signed currents [A], one per channel. Must be repeated within the watchdog time, even if
  /// unchanged.
  virtual DriveStatus drive(std::span<const double> currents) = 0;
  /// Whether the device computes currents from a commanded field; drive() then accepts only zeros.
  virtual bool takes_field() const { return false; }
  /// Like drive(), with the field [mT] that these currents make at the swarm.
  virtual DriveStatus drive_field(std::span<const double, 3> field,
                                  std::span<const double> currents);
  /// Whether the device makes waveforms.
  virtual bool makes_waveforms() const { return false; }
  /// Starts a waveform or changes the running one. To be repeated like drive(), which ends it.
  virtual DriveStatus drive_waveform(const CurrentWaveform&) { return DriveStatus::refused; }
  /// Phase of the waveform at the device's last answer [rad]; nothing if unknown.
  virtual std::optional<double> phase() const { return std::nullopt; }
  /// Sets all currents to zero. The time of the report is set by who asks for it.
  virtual StopReport stop() noexcept = 0;
  /// Aborts a drive() in another thread, so that stop() can run. Callable from any thread; lasts
  /// until the next stop().
  virtual void interrupt() noexcept {}
  /// Cause of the last trouble, one printable line; empty if unknown.
  virtual std::string reason() const { return {}; }
};

/// Driver without hardware.
class SimulatedCoilDriver final : public CoilDriver {
 public:
  /// `full_scale` is the maximum current [A]. With `waveforms` it makes waveforms, at the commanded
  /// phase.
  SimulatedCoilDriver(int channels, double full_scale, bool waveforms = false);

  int channels() const override { return static_cast<int>(currents_.size()); }
  DriveStatus drive(std::span<const double> currents) override;
  bool makes_waveforms() const override { return waveforms_; }
  DriveStatus drive_waveform(const CurrentWaveform& waveform) override;
  std::optional<double> phase() const override { return phase_; }
  StopReport stop() noexcept override;
  std::span<const double> currents() const override { return currents_; }

 private:
  std::vector<double> currents_;
  double full_scale_;
  bool waveforms_;
  std::optional<double> phase_;  // as last commanded
};

}  // namespace microswarm
