// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/actuation/drivers/coil_link.hpp"
#include "microswarm/actuation/drivers/missing_answer.hpp"
#include "microswarm/actuation/drivers/output_check.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm::actuation {

/// Serial port and timeouts of the device.
struct SerialCoilParams {
  static constexpr std::string_view type_name = "serial";
  static constexpr bool is_device = true;
  std::string port = "/dev/ttyACM0";
  double full_scale = 20;
  double reply_timeout = 0.02;
  int attempts = 3;
  double boot_time = 2;
  double connect_timeout = 5;
  bool waveforms = false;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.port, plain("port", "Serial port of the device."));
    visit(self.full_scale, a("full_scale", 1e-6, 1000, "Current of a channel at full output."));
    visit(self.reply_timeout, s("reply_timeout", 0.001, 1, "Longest wait for an answer."));
    visit(self.attempts, plain("attempts", 1, 20, "Number of times a message is sent."));
    visit(self.boot_time,
          s("boot_time", 0, 10, "Silence after opening the port, for a bootloader."));
    visit(self.connect_timeout,
          s("connect_timeout", 0.1, 60, "Longest wait for the first answer."));
    visit(self.waveforms,
          plain("waveforms", "The device turns the field; the host only steers it."));
  }
  CoilInput input() const { return waveforms ? CoilInput::waveform : CoilInput::currents; }
  int channel_count(std::size_t) const { return coil_link_channels; }
  Issues validate(double) const { return {}; }
  std::unique_ptr<CoilDriver> open(const CoilSite& site) const;
};

/// Driver of six coils on an Arduino Mega 2560 with firmware/coil_driver
/// (docs/reference/protocol.md). A Mega that was reset runs its bootloader, which takes any byte
/// for the start of an upload and then listens for seconds. The driver therefore stays silent after
/// opening the port until the firmware reports its start or `boot_time` is over. After three
/// exchanges without an answer it sends only stop, until that report or for 3 · `boot_time`.
class SerialCoilDriver final : public CoilDriver {
 public:
  /// Opens the port and identifies the device. The device is armed by the first currents. Throws
  /// HardwareError if the port does not exist or is used by another program, nothing answers in
  /// time, or the device speaks another protocol version.
  explicit SerialCoilDriver(const SerialCoilParams& params);
  ~SerialCoilDriver() override;
  SerialCoilDriver(const SerialCoilDriver&) = delete;
  SerialCoilDriver& operator=(const SerialCoilDriver&) = delete;

  Capabilities capabilities() const override { return {coil_link_channels, params_.input()}; }
  DriveStatus drive(const CoilRequest& request) override;
  const DeviceReport& report() const override { return report_; }
  /// Sent also after three exchanges without an answer. Waits at most 2 s for the confirmation.
  StopReport stop() noexcept override;
  void interrupt() noexcept override { interrupted_ = true; }

  /// Status reported by the device; nothing if it does not answer.
  std::optional<CoilReply> ask_status();

 private:
  class Port;

  DriveStatus hold(std::span<const double> currents);
  DriveStatus turn(const CurrentWaveform& waveform);
  DriveStatus follow(CoilMessage message, const CoilAim& aim);
  bool to_outputs(std::span<const double> currents, CoilOutputs& outputs) const;
  std::vector<std::uint8_t> to_bytes(CoilMessage message, const CoilAim& aim) const;
  std::optional<CoilReply> exchange(CoilMessage message, const CoilAim& aim = {});
  std::optional<CoilReply> answer_to(CoilMessage message, double timeout, const Stop& gives_up);
  bool hears_start(double timeout);
  bool keeps_silent();
  void take_temperature(const CoilReply& reply);
  DriveStatus refusal(const CoilReply& reply);
  DriveStatus arm();

  SerialCoilParams params_;
  std::unique_ptr<Port> port_;
  CoilReplyReader reader_;
  OutputCheck check_;
  std::uint8_t sequence_ = 0;
  int clock_ = 0;        // device's clock in its last reply [ms]
  double clock_at_ = 0;  // arrival of that reply [s], by steady_seconds()
  int begin_phase_ = 0;  // of the next waveform [turns / 65536]
  DeviceReport report_;
  CoilOutputs probes_;  // temperatures as last reported [0.1 °C], or marks
  MissingAnswer missing_;
  double round_trip_ = 0;  // of the last exchange, from its first sending [s]
  std::atomic<bool> interrupted_ = false;
  int failures_ = 0;         // consecutive exchanges without an answer
  double silent_until_ = 0;  // [s], by steady_seconds()
  bool armed_ = false;       // armed by this driver and not stopped since
};

}  // namespace microswarm::actuation
