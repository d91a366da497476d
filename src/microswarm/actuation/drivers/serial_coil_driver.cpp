// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/serial_coil_driver.hpp"

#include <fmt/core.h>
#include <sys/file.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "microswarm/actuation/drivers/byte_stream.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::actuation {
namespace {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

constexpr unsigned baud = 115200;
constexpr double left_over = 0.03;  // [s] after opening; a reset takes longer
constexpr std::chrono::seconds max_stop{2};
constexpr int max_failures = 3;  // exchanges in a row
// A bootloader that received a byte listens for 5 s more.
constexpr double silence_per_boot_time = 3;

/// Whether it is a temperature, not a mark.
bool is_temperature(int probe) { return std::abs(probe) < coil_link_probe_open; }

/// The warmest of probes, by their temperatures [0.1 °C] or marks.
std::string hottest_text(const CoilOutputs& probes) {
  std::size_t hottest = 0;
  for (std::size_t c = 0; c < probes.size(); ++c)
    if (is_temperature(probes[c]) && probes[c] > probes[hottest]) hottest = c;
  return fmt::format("the probe of channel {} shows {:.1f} °C, and the firmware has a limit",
                     hottest + 1, 0.1 * probes[hottest]);
}

/// Trouble with probes, by their temperatures or marks; empty if nothing is.
std::string probe_trouble(const CoilOutputs& probes) {
  std::string trouble;
  for (std::size_t c = 0; c < probes.size(); ++c)
    if (probes[c] != coil_link_no_probe && !is_temperature(probes[c]))
      trouble += fmt::format("{}the probe of channel {} is {}", trouble.empty() ? "" : ", ", c + 1,
                             probes[c] == coil_link_probe_open ? "open" : "shorted");
  return trouble;
}

}  // namespace

/// The serial port, opened exclusively.
class SerialCoilDriver::Port {
 public:
  explicit Port(const std::string& path) : port_(context_) {
    boost::system::error_code error;
    port_.open(path, error);
    const bool taken = error == boost::system::errc::device_or_resource_busy;
    if (error && !taken)
      throw HardwareError(fmt::format("{}: cannot open: {}", path, error.message()));
    if (taken || (::flock(port_.native_handle(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK))
      throw HardwareError(path + ": another program drives coils there");
    // Keeps programs out that ignore locks. A pseudo-terminal would stay closed permanently.
    int lines = 0;
    if (::ioctl(port_.native_handle(), TIOCMGET, &lines) == 0)
      ::ioctl(port_.native_handle(), TIOCEXCL);
    using Base = asio::serial_port_base;
    const auto set = [&](const auto& option) {
      port_.set_option(option, error);
      if (error) throw HardwareError(fmt::format("{}: no serial line: {}", path, error.message()));
    };
    set(Base::baud_rate(baud));
    set(Base::character_size(8));
    set(Base::parity(Base::parity::none));
    set(Base::stop_bits(Base::stop_bits::one));
    set(Base::flow_control(Base::flow_control::none));
    stream_.emplace(port_.native_handle(), port_.native_handle());
    stream_->discard(left_over);
  }
  ByteStream* operator->() { return &*stream_; }

 private:
  asio::io_context context_;
  asio::serial_port port_;
  std::optional<ByteStream> stream_;
};

std::unique_ptr<CoilDriver> SerialCoilParams::open(const CoilSite&) const {
  return std::make_unique<SerialCoilDriver>(*this);
}

SerialCoilDriver::SerialCoilDriver(const SerialCoilParams& params)
    : params_(params),
      port_(std::make_unique<Port>(params.port)),
      report_{.currents = std::vector<double>(coil_link_channels)},
      missing_(params.reply_timeout) {
  probes_.fill(coil_link_no_probe);
  hears_start(params_.boot_time);
  const std::array<std::uint8_t, 1> end{0};  // ends any partial message
  (*port_)->put(end, params_.reply_timeout, {});
  const auto began = Clock::now();
  std::optional<CoilReply> reply;
  while (!reply && !(*port_)->ended() && seconds_since(began) < params_.connect_timeout) {
    failures_ = 0;  // it may not be a stock Mega
    reply = exchange(CoilMessage::hello);
  }
  if (!reply && (*port_)->ended())
    throw HardwareError(fmt::format("{}: {}", params_.port, report_.reason));
  if (!reply)
    throw HardwareError(fmt::format("{}: no answer within {} s; {}", params_.port,
                                    params_.connect_timeout, report_.reason));
  if (reply->version != coil_link_version || reply->result != CoilResult::ok)
    throw HardwareError(fmt::format(
        "{0}: its firmware speaks version {1} of the protocol, this program {2}; renew it "
        "with microswarm rig flash, port {0}, with the settings of before",
        params_.port, reply->version, coil_link_version));
}

SerialCoilDriver::~SerialCoilDriver() { stop(); }

DriveStatus SerialCoilDriver::drive(const CoilRequest& request) {
  return std::visit(Overloaded{[&](std::span<const double> currents) { return hold(currents); },
                               [](const FieldRequest&) { return DriveStatus::refused; },
                               [&](const CurrentWaveform& waveform) { return turn(waveform); }},
                    request);
}

DriveStatus SerialCoilDriver::hold(std::span<const double> currents) {
  assert(currents.size() == coil_link_channels);
  CoilAim aim;
  if (!to_outputs(currents, aim.constant)) return DriveStatus::refused;
  report_.phase.reset();
  return follow(CoilMessage::set, aim);
}

DriveStatus SerialCoilDriver::turn(const CurrentWaveform& waveform) {
  const double mhz = 1e3 * waveform.frequency;
  if (!(std::abs(mhz) <= coil_link_max_frequency)) return DriveStatus::refused;
  CoilAim aim{.frequency = static_cast<int>(std::lround(mhz))};
  if (!to_outputs(waveform.constant, aim.constant) || !to_outputs(waveform.cosine, aim.cosine) ||
      !to_outputs(waveform.sine, aim.sine))
    return DriveStatus::refused;
  for (std::size_t c = 0; c < report_.currents.size(); ++c)
    if (!(waveform.largest(c) <= params_.full_scale * (1 + full_scale_slack)))
      return DriveStatus::refused;
  constexpr int turn = 65536;
  begin_phase_ = static_cast<int>(std::lround(waveform.phase / (2 * pi) * turn)) & (turn - 1);
  return follow(CoilMessage::waveform, aim);
}

bool SerialCoilDriver::to_outputs(std::span<const double> currents, CoilOutputs& outputs) const {
  assert(currents.size() == outputs.size());
  for (std::size_t c = 0; c < currents.size(); ++c) {
    const double share = currents[c] / params_.full_scale;
    if (!(std::abs(share) <= 1 + full_scale_slack)) return false;
    outputs[c] = static_cast<int>(std::lround(share * coil_link_full_scale));
  }
  return true;
}

DriveStatus SerialCoilDriver::follow(CoilMessage message, const CoilAim& aim) {
  DriveStatus status = DriveStatus::driven;
  if (!armed_)  // not before: the watchdog starts immediately
    if (const DriveStatus armed = arm(); armed != DriveStatus::driven) return armed;
  auto reply = exchange(message, aim);
  if (reply && reply->result == CoilResult::not_armed) {
    if (reply->trip != CoilTrip::none && reply->trip != CoilTrip::silence) return refusal(*reply);
    if (const DriveStatus armed = arm(); armed != DriveStatus::driven) return armed;
    reply = exchange(message, aim);
    status = DriveStatus::resumed;
  }
  if (!reply || reply->result == CoilResult::stale) {
    check_.forget();
    if (reply)
      report_.reason =
          "a message came too late for it; " + late_answer_text(round_trip_, params_.reply_timeout);
    return DriveStatus::no_answer;
  }
  if (reply->result == CoilResult::not_armed) return refusal(*reply);
  const bool obeyed = reply->result == CoilResult::ok || reply->result == CoilResult::limited;
  if (!obeyed || !check_.agrees(aim, *reply)) return DriveStatus::mismatched;
  report_.scale = static_cast<double>(reply->scale) / coil_link_unscaled;
  if (status == DriveStatus::resumed) return status;
  return reply->result == CoilResult::limited ? DriveStatus::scaled : status;
}

StopReport SerialCoilDriver::stop() noexcept {
  interrupted_ = false;
  try {
    const auto reply = exchange(CoilMessage::stop);
    const bool at_zero = reply && std::all_of(reply->outputs.begin(), reply->outputs.end(),
                                              [](int output) { return output == 0; });
    armed_ = armed_ && !at_zero;
    return {.confirmed = at_zero};
  } catch (...) {
    return {};  // out of memory; the device's watchdog switches off
  }
}

std::optional<CoilReply> SerialCoilDriver::ask_status() { return exchange(CoilMessage::status); }

/// Keeps the temperature that a reply has of one of the channels.
void SerialCoilDriver::take_temperature(const CoilReply& reply) {
  int& known = probes_[reply.probe];
  if (known == reply.temperature) return;
  known = reply.temperature;
  report_.temperatures.assign(probes_.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < probes_.size(); ++c)
    if (is_temperature(probes_[c])) report_.temperatures[c] = 0.1 * probes_[c];
  report_.probe_trouble = probe_trouble(probes_);
}

/// Status of a device that must not be armed, with its reason.
DriveStatus SerialCoilDriver::refusal(const CoilReply& reply) {
  if (reply.trip == CoilTrip::emergency) return DriveStatus::emergency;
  if (reply.trip != CoilTrip::hot && reply.trip != CoilTrip::probe) return DriveStatus::not_armed;
  for (int c = 0; c < coil_link_channels; ++c) ask_status();  // each has one probe
  report_.reason = reply.trip == CoilTrip::probe ? report_.probe_trouble : hottest_text(probes_);
  return DriveStatus::not_armed;
}

DriveStatus SerialCoilDriver::arm() {
  const auto reply = exchange(CoilMessage::arm);
  if (!reply) return DriveStatus::no_answer;
  armed_ = reply->result == CoilResult::ok && reply->state == CoilState::armed;
  if (!armed_) return refusal(*reply);
  check_.begin(*reply);
  return DriveStatus::driven;
}

std::vector<std::uint8_t> SerialCoilDriver::to_bytes(CoilMessage message,
                                                     const CoilAim& aim) const {
  if (message == CoilMessage::hello) return encode_hello(sequence_);
  if (message != CoilMessage::set && message != CoilMessage::waveform)
    return encode(message, sequence_);
  // Two maximum round trips from now, since the device's clock is known with a delay of one.
  const double validity = steady_seconds() - clock_at_ + 2 * params_.reply_timeout;
  const int deadline = clock_ + static_cast<int>(std::lround(1e3 * validity));
  if (message == CoilMessage::set) return encode_set(sequence_, deadline, aim.constant);
  return encode_waveform(sequence_, deadline, begin_phase_, aim);
}

// Resends the same message with the same number until it is answered; the device executes it once.
std::optional<CoilReply> SerialCoilDriver::exchange(CoilMessage message, const CoilAim& aim) {
  if (message != CoilMessage::stop && keeps_silent()) return std::nullopt;
  const double began = steady_seconds();
  missing_.expect(++sequence_, began);
  const Stop gives_up = message == CoilMessage::stop ? Stop(max_stop) : Stop(&interrupted_);
  for (int k = 0; k < params_.attempts && !gives_up(); ++k) {
    if (!(*port_)->put(to_bytes(message, aim), params_.reply_timeout, gives_up)) continue;
    missing_.sent();
    if (auto reply = answer_to(message, params_.reply_timeout, gives_up)) {
      clock_at_ = steady_seconds();
      round_trip_ = clock_at_ - began;
      missing_.answered();
      failures_ = 0;
      report_.reason.clear();
      clock_ = reply->clock;
      if (reply->version == coil_link_version) take_temperature(*reply);
      if (message == CoilMessage::waveform) report_.phase = 2 * pi * reply->phase / 65536;
      for (std::size_t c = 0; c < report_.currents.size(); ++c)
        report_.currents[c] = params_.full_scale * reply->outputs[c] / coil_link_full_scale;
      return reply;
    }
  }
  report_.reason =
      (*port_)->ended() ? "the port has vanished" + (*port_)->failure() : missing_.text();
  if (++failures_ >= max_failures)
    silent_until_ = steady_seconds() + silence_per_boot_time * params_.boot_time;
  return std::nullopt;
}

bool SerialCoilDriver::keeps_silent() {
  if (failures_ < max_failures) return false;
  if (!hears_start(0) && steady_seconds() < silent_until_) return true;
  failures_ = 0;
  return false;
}

/// Whether the device reports its start within `timeout` seconds.
bool SerialCoilDriver::hears_start(double timeout) {
  const auto began = Clock::now();
  for (;;) {
    const auto byte = (*port_)->get(timeout - seconds_since(began));
    if (!byte && seconds_since(began) >= timeout) return false;
    if (!byte) continue;
    const auto reply = reader_.take(*byte);
    if (reply && reply->to == CoilMessage::started) return true;
  }
}

std::optional<CoilReply> SerialCoilDriver::answer_to(CoilMessage message, double timeout,
                                                     const Stop& gives_up) {
  const auto began = Clock::now();
  for (;;) {
    const double left = timeout - seconds_since(began);
    if (left <= 0 || gives_up()) return std::nullopt;
    const auto byte = (*port_)->get(std::min(left, stream_slice));
    if (!byte && (*port_)->ended()) return std::nullopt;
    if (!byte) continue;
    missing_.take(*byte);
    auto reply = reader_.take(*byte);
    if (reply && reply->to == message && reply->sequence == sequence_) return reply;
    if (reply) missing_.other(reply->sequence, steady_seconds());
  }
}

}  // namespace microswarm::actuation
