// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace microswarm::actuation {

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
std::string_view trouble_text(DriveStatus status);

/// The most that a device does by itself.
enum class CoilInput : std::uint8_t {
  currents,  ///< it holds the currents that it is sent
  field,     ///< it computes the currents of a field by itself; it takes no currents
  waveform,  ///< it turns currents by itself; it also holds constant ones
};

/// Properties of an open driver; they never change.
struct Capabilities {
  int channels = 0;  ///< currents of a request
  CoilInput input = CoilInput::currents;
};

/// A field [mT] for a device that computes the currents.
struct FieldRequest {
  std::span<const double, 3> field;
  std::span<const double> currents{};  ///< that make it in the coil system's model [A]
};

/// Currents that the device turns by itself: constant + cosine cos φ + sine sin φ [A], one of each
/// per channel, with a phase φ that turns at `frequency` [Hz].
struct CurrentWaveform {
  double frequency = 0;  ///< [Hz], negative backwards
  double phase = 0;      ///< of a starting waveform [rad]; a running one keeps its own
  std::span<const double> constant{}, cosine{}, sine{};

  /// Peak current of a channel within a turn [A].
  double largest(std::size_t channel) const;
};

/// Request to the device: signed currents [A], one per channel, a field, or a waveform. It
/// refers to values that must outlive it.
using CoilRequest = std::variant<std::span<const double>, FieldRequest, CurrentWaveform>;

/// The request for constant currents [A] that make `field` [mT], as the device takes it.
CoilRequest constant_request(const Capabilities& device, std::span<const double, 3> field,
                             std::span<const double> currents);

/// State of the coils as last reported by the device.
struct DeviceReport {
  std::vector<double> currents{};  ///< [A]; of a field, the coil system's model
  double scale = 1;                ///< by the device's own limits, of the last acknowledged
                                   ///< request, in [0, 1]
  /// Temperatures of the channels' coils by probes, as last acknowledged [°C]; NaN for a coil
  /// without one, empty for a device without probes.
  std::vector<double> temperatures{};
  std::string probe_trouble{};    ///< which probes show nothing, and why; empty if all are well
  std::optional<double> phase{};  ///< of the waveform [rad]; empty if unknown
  std::string reason{};           ///< cause of the last trouble, one printable line; empty if
                                  ///< unknown
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

/// Interface that sends requests to the device of the coils. The destructor sets all currents to
/// zero.
class CoilDriver {
 public:
  CoilDriver() = default;
  CoilDriver(const CoilDriver&) = delete;
  CoilDriver& operator=(const CoilDriver&) = delete;
  virtual ~CoilDriver() = default;

  virtual Capabilities capabilities() const = 0;
  /// Sends a request; refused if the device does not take its kind. Must be repeated within the
  /// watchdog time, even if unchanged. A waveform starts or changes the running one, another
  /// request ends it.
  virtual DriveStatus drive(const CoilRequest& request) = 0;
  virtual const DeviceReport& report() const = 0;
  /// Sets all currents to zero. The time of the report is set by who asks for it.
  virtual StopReport stop() noexcept = 0;
  /// Aborts a drive() in another thread, so that stop() can run. Callable from any thread; lasts
  /// until the next stop().
  virtual void interrupt() noexcept {}
};

/// Coils that a driver is opened for.
struct CoilSite {
  std::filesystem::path folder{};  ///< of the rig's file
  std::filesystem::path coils{};   ///< file of the coil system
  std::size_t count = 0;           ///< number of coils
};

/// Why this status ends a run, with the driver's own reason; also for no_answer.
std::string trouble_text(const CoilDriver& driver, DriveStatus status);

}  // namespace microswarm::actuation
