// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/actuation/drivers/line_connection.hpp"
#include "microswarm/actuation/drivers/line_protocol.hpp"
#include "microswarm/actuation/drivers/missing_answer.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm::actuation {

/// Quantity that is sent to a user-supplied driver.
enum class DriverInput { currents, field };
constexpr auto enum_names(DriverInput) {
  return std::array<std::pair<DriverInput, std::string_view>, 2>{
      {{DriverInput::currents, "currents"}, {DriverInput::field, "field"}}};
}

/// Common parameters of driver programs and sockets.
struct LineDriverParams {
  static constexpr bool is_device = true;
  DriverInput send = DriverInput::currents;
  std::optional<int> channels{};
  double full_scale = 20;
  double tolerance = 0.01;
  double watchdog = 0.2;
  double reply_timeout = 0.05;
  double connect_timeout = 10;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.send, plain("send", "Currents in A, or the field in mT at the swarm."));
    visit(self.channels, plain("channels", 1, line_protocol_values,
                               "Currents of a message; none: one for each coil."));
    visit(self.full_scale, a("full_scale", 1e-6, 1e6, "Largest current of a channel."));
    visit(self.tolerance,
          plain("tolerance", 1e-6, 1, "Allowed error of acknowledged values, A or mT."));
    visit(self.watchdog, s("watchdog", 0.02, 10, "Silence after which the driver turns off."));
    visit(self.reply_timeout, s("reply_timeout", 0.001, 1, "Longest wait for an answer."));
    visit(self.connect_timeout,
          s("connect_timeout", 0.1, 300, "Longest wait for the first answer."));
  }
  CoilInput input() const {
    return send == DriverInput::field ? CoilInput::field : CoilInput::currents;
  }
  /// All coils make a field, for any value of `channels`.
  int channel_count(std::size_t coils) const {
    return input() == CoilInput::field ? static_cast<int>(coils)
                                       : channels.value_or(static_cast<int>(coils));
  }
  Issues validate(double drive_rate) const;
};

/// A user-supplied program that drives the coils.
struct ProgramDriverParams : LineDriverParams {
  static constexpr std::string_view type_name = "program";
  std::vector<std::string> command{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.command,
          plain("command", "Program and its arguments, started beside the rig's file.").needed());
    LineDriverParams::fields(self, visit);
  }
  Issues validate(double drive_rate) const;
  std::unique_ptr<CoilDriver> open(const CoilSite& site) const;
};

/// A user-supplied server that drives the coils.
struct SocketDriverParams : LineDriverParams {
  static constexpr std::string_view type_name = "socket";
  std::string host = "localhost";
  int port = 5025;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.host, plain("host", "Host, or path of a Unix socket."));
    visit(self.port, plain("port", 1, 65535, "TCP port; not for a Unix socket."));
    LineDriverParams::fields(self, visit);
  }
  std::unique_ptr<CoilDriver> open(const CoilSite& site) const;
};

/// Driver that speaks the line protocol (docs/reference/line-protocol.md) with a user-supplied
/// program or server, which must turn the coils off if it obeys no message for the watchdog time. A
/// card may hold the outputs of a program that ended or hangs: if a stop is not answered with
/// zeros, the connection is closed and opened once more, so that a second hello turns the outputs
/// off. After that the driver refuses to drive.
class LineCoilDriver final : public CoilDriver {
 public:
  /// Opens the connection and says hello. `coils` is the number of currents that are sent or that
  /// make the field; `lock` is held for the driver's lifetime. Throws HardwareError if no answer
  /// arrives in time or it is a refusal.
  LineCoilDriver(OpenConnection open, const LineDriverParams& params, std::size_t coils,
                 std::unique_ptr<DeviceLock> lock = nullptr);
  ~LineCoilDriver() override;
  LineCoilDriver(const LineCoilDriver&) = delete;
  LineCoilDriver& operator=(const LineCoilDriver&) = delete;

  Capabilities capabilities() const override;
  DriveStatus drive(const CoilRequest& request) override;
  const DeviceReport& report() const override { return report_; }
  /// Waits at most 0.5 s for the confirmation, `reply_timeout` after three misses in a row that
  /// were no late answers. What does not answer is killed at once; the next connection has 2 s for
  /// its hello.
  StopReport stop() noexcept override;
  void interrupt() noexcept override { interrupted_ = true; }

 private:
  void greet(double timeout);
  StopReport begin_again(std::string_view trouble);
  bool is_possible(std::span<const double> currents) const;
  DriveStatus refuse(const char* reason);
  DriveStatus follow(std::span<const double> values, std::span<const double> currents);
  DriveStatus arm();
  DriveStatus take(const std::optional<LineReply>& reply);
  void take_temperatures(std::vector<double> now);
  DriveStatus compare(std::span<const double> values, const LineReply& reply, double& scale);
  bool is_zero(const LineReply& reply) const;
  std::optional<LineReply> exchange(std::string_view word, double timeout, const Stop& gives_up,
                                    std::span<const double> values = {});
  std::optional<LineReply> answer(double timeout, const Stop& gives_up);
  bool is_gone();
  std::string last_words();

  std::unique_ptr<DeviceLock> lock_;
  OpenConnection open_;
  std::unique_ptr<LineConnection> connection_;
  LineDriverParams params_;
  DeviceReport report_;
  std::size_t sent_;         // number of values in a message
  std::vector<bool> shown_;  // whether the channel's probe has shown a temperature
  LineReader reader_;
  std::uint32_t sequence_ = 0;
  std::atomic<bool> interrupted_ = false;
  bool armed_ = false;                         // armed by this driver and not stopped since
  int misses_ = 0;                             // consecutive messages without an answer
  bool gone_ = false;                          // permanently
  std::optional<StopReport> turned_off_anew_;  // by a second connection
  MissingAnswer missing_;
};

}  // namespace microswarm::actuation
