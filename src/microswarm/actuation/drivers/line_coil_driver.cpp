// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/line_coil_driver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr double stop_wait = 0.5;  // [s] for the confirmation of zeros
constexpr double hello_wait = 2;   // [s] for the answer to the second hello

std::span<const std::uint8_t> to_bytes(const std::string& text) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Best estimate of the factor by which all values were scaled, in [0, 1].
double scale_between(std::span<const double> values, std::span<const double> applied) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    product += values[i] * applied[i];
    square += values[i] * values[i];
  }
  return square > 0 ? std::clamp(product / square, 0.0, 1.0) : 1;
}

/// Updates that fit into the watchdog's time, at least.
constexpr double min_updates = 2;

std::string to_list(std::span<const double> values) {
  return one_line(fmt::format("{:.6g}", fmt::join(values, " ")), 100);
}

}  // namespace

Issues LineDriverParams::validate(double drive_rate) const {
  Issues issues;
  const double least = min_updates / drive_rate;
  if (watchdog < least)
    issues.add({"driver.watchdog_s", "drive_rate_hz"},
               fmt::format("driver.watchdog_s is {:.6g}, two updates at drive_rate_hz {:.6g} take "
                           "{:.6g}",
                           watchdog, drive_rate, least));
  if (send == DriverInput::field && channels)
    issues.add({"driver.channels", "driver"},
               "driver.channels is of currents, the driver is sent the field");
  return issues;
}

Issues ProgramDriverParams::validate(double drive_rate) const {
  Issues issues;
  if (command.empty() || command.front().empty())
    issues.add({"driver.command", "driver"}, "the command of the driver is empty");
  issues.add(LineDriverParams::validate(drive_rate));
  return issues;
}

std::unique_ptr<CoilDriver> ProgramDriverParams::open(const CoilSite& site) const {
  auto lock = std::make_unique<DeviceLock>(site.coils, to_device(command, site.folder));
  return std::make_unique<LineCoilDriver>(
      [command = command, folder = site.folder, locks = lock->descriptors()](double) {
        return start_program(command, folder, locks);
      },
      *this, site.count, std::move(lock));
}

std::unique_ptr<CoilDriver> SocketDriverParams::open(const CoilSite& site) const {
  // A Unix socket's path is relative to the rig's file.
  const bool is_path = host.find('/') != std::string::npos;
  const std::string at = is_path ? (site.folder / host).string() : host;
  return std::make_unique<LineCoilDriver>(
      [at, port = port](double timeout) { return connect_socket(at, port, timeout); }, *this,
      site.count, std::make_unique<DeviceLock>(site.coils, to_device(at, port)));
}

LineCoilDriver::LineCoilDriver(OpenConnection open, const LineDriverParams& params,
                               std::size_t coils, std::unique_ptr<DeviceLock> lock)
    : lock_(std::move(lock)),
      open_(std::move(open)),
      connection_(open_(params.connect_timeout)),
      params_(params),
      report_{.currents =
                  std::vector<double>(static_cast<std::size_t>(params.channel_count(coils)))},
      sent_(params.send == DriverInput::field ? 3 : report_.currents.size()),
      missing_(params.reply_timeout) {
  greet(params_.connect_timeout);
}

void LineCoilDriver::greet(double timeout) {
  const auto fail = [&](const std::string& why) {
    throw HardwareError(fmt::format("{}: {}", connection_->name(), why));
  };
  const auto reply = exchange("hello", timeout, {});
  if (!reply && gone_) throw HardwareError(report_.reason);
  if (!reply) fail(fmt::format("no answer within {:g} s; {}", timeout, report_.reason));
  if (reply->verdict != LineVerdict::ok) fail("refuses: " + reply->text);
  if (!is_zero(*reply))
    fail(fmt::format("acknowledges {} as its values, not {} zeros", to_list(reply->values), sent_));
}

LineCoilDriver::~LineCoilDriver() { stop(); }

bool LineCoilDriver::is_possible(std::span<const double> currents) const {
  return std::ranges::all_of(currents, [&](double current) {
    return std::abs(current) <= params_.full_scale * (1 + full_scale_slack);
  });
}

Capabilities LineCoilDriver::capabilities() const {
  return {static_cast<int>(report_.currents.size()), params_.input()};
}

DriveStatus LineCoilDriver::drive(const CoilRequest& request) {
  const bool field = params_.send == DriverInput::field;
  return std::visit(
      Overloaded{[&](std::span<const double> currents) {
                   return field ? refuse("it takes a field") : follow(currents, currents);
                 },
                 [&](const FieldRequest& wanted) {
                   return field ? follow(wanted.field, wanted.currents)
                                : refuse("it takes currents");
                 },
                 [&](const CurrentWaveform&) { return refuse("it makes no waveform"); }},
      request);
}

DriveStatus LineCoilDriver::refuse(const char* reason) {
  report_.reason = reason;
  return DriveStatus::refused;
}

DriveStatus LineCoilDriver::follow(std::span<const double> values,
                                   std::span<const double> currents) {
  assert(currents.size() == report_.currents.size());
  if (gone_) return DriveStatus::gone;
  report_.reason.clear();
  const bool finite =
      std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
  if (!finite || !is_possible(currents)) return DriveStatus::refused;
  DriveStatus status = DriveStatus::driven;
  if (!armed_)  // not before: the watchdog starts immediately
    if (const DriveStatus armed = arm(); armed != DriveStatus::driven) return armed;
  const Stop gives_up(&interrupted_);
  auto reply = exchange("set", params_.reply_timeout, gives_up, values);
  if (reply && reply->verdict == LineVerdict::off) {
    if (const DriveStatus armed = arm(); armed != DriveStatus::driven) return armed;
    reply = exchange("set", params_.reply_timeout, gives_up, values);
    status = DriveStatus::resumed;
  }
  if (const DriveStatus trouble = take(reply); trouble != DriveStatus::driven) return trouble;
  double scale = 1;
  const DriveStatus compared = compare(values, *reply, scale);
  if (compared == DriveStatus::mismatched) return compared;
  report_.scale = scale;
  take_temperatures(std::move(reply->temperatures));
  for (std::size_t i = 0; i < currents.size(); ++i) report_.currents[i] = scale * currents[i];
  return status == DriveStatus::driven ? compared : status;
}

/// Keeps the temperatures; a probe that showed one before and does no more is trouble.
void LineCoilDriver::take_temperatures(std::vector<double> now) {
  shown_.resize(std::max(shown_.size(), now.size()));
  report_.probe_trouble.clear();
  for (std::size_t c = 0; c < shown_.size(); ++c) {
    const bool shows = c < now.size() && !std::isnan(now[c]);
    if (shown_[c] && !shows)
      report_.probe_trouble += fmt::format("{}the probe of channel {} shows nothing any more",
                                           report_.probe_trouble.empty() ? "" : ", ", c + 1);
    shown_[c] = shown_[c] || shows;
  }
  report_.temperatures = std::move(now);
}

/// Status of a reply, before its values are compared.
DriveStatus LineCoilDriver::take(const std::optional<LineReply>& reply) {
  if (!reply) return gone_ ? DriveStatus::gone : DriveStatus::no_answer;
  report_.reason = reply->text;
  switch (reply->verdict) {
    case LineVerdict::ok:
    case LineVerdict::limited:
      return DriveStatus::driven;
    case LineVerdict::off:
      return DriveStatus::not_armed;
    case LineVerdict::refused:
      return DriveStatus::refused;
    case LineVerdict::emergency:
      return DriveStatus::emergency;
  }
  assert(false);
  return DriveStatus::mismatched;
}

/// Status that says whether the acknowledged values are those sent, or scaled by one factor.
DriveStatus LineCoilDriver::compare(std::span<const double> values, const LineReply& reply,
                                    double& scale) {
  const bool limited = reply.verdict == LineVerdict::limited;
  bool agree = reply.values.size() == values.size();
  if (agree && limited) scale = scale_between(values, reply.values);
  for (std::size_t i = 0; agree && i < values.size(); ++i)
    agree = std::abs(reply.values[i] - scale * values[i]) <= params_.tolerance;
  if (agree) return limited ? DriveStatus::scaled : DriveStatus::driven;
  report_.reason = fmt::format("sent {}, acknowledged {}", to_list(values),
                               reply.values.empty() ? "no numbers" : to_list(reply.values));
  return DriveStatus::mismatched;
}

DriveStatus LineCoilDriver::arm() {
  const auto reply = exchange("arm", params_.reply_timeout, Stop(&interrupted_));
  DriveStatus status = take(reply);
  if (status == DriveStatus::refused) status = DriveStatus::not_armed;
  if (status == DriveStatus::driven && !is_zero(*reply)) {
    report_.reason = fmt::format("armed with {}, not {} zeros", to_list(reply->values), sent_);
    status = DriveStatus::mismatched;
  }
  armed_ = status == DriveStatus::driven;
  return status;
}

StopReport LineCoilDriver::stop() noexcept {
  interrupted_ = false;
  try {
    if (gone_) return begin_again("had ended");
    const bool is_lost = misses_ >= max_missed_answers && !missing_.is_late();
    const double wait =
        is_lost ? params_.reply_timeout : std::max(stop_wait, params_.reply_timeout);
    const auto reply = exchange("stop", wait, {});
    if (!reply && gone_) return begin_again("had ended");
    if (!reply) {
      connection_->give_up();
      return begin_again("did not answer stop; it was ended");
    }
    if (reply->verdict != LineVerdict::ok || !is_zero(*reply))
      return begin_again("did not say zero to stop; it was ended");
    armed_ = false;
    std::ranges::fill(report_.currents, 0.0);
    return {.confirmed = true};
  } catch (...) {
    return {};  // out of memory; the driver's watchdog switches off
  }
}

StopReport LineCoilDriver::begin_again(std::string_view trouble) {
  if (turned_off_anew_) return *turned_off_anew_;
  turned_off_anew_.emplace();
  const std::string reason = report_.reason;
  connection_.reset();
  reader_ = {};  // it may hold half a line
  try {
    const double timeout = std::min(hello_wait, params_.connect_timeout);
    connection_ = open_(timeout);
    greet(timeout);
    turned_off_anew_ = {.confirmed = true,
                        .trouble = fmt::format("{}, and a second one said zero", trouble)};
    std::ranges::fill(report_.currents, 0.0);
  } catch (const HardwareError&) {  // not confirmed
  }
  gone_ = true;
  report_.reason = reason;
  return *turned_off_anew_;
}

bool LineCoilDriver::is_zero(const LineReply& reply) const {
  return reply.values.size() == sent_ && std::ranges::all_of(reply.values, [&](double value) {
           return std::abs(value) <= params_.tolerance;
         });
}

std::optional<LineReply> LineCoilDriver::exchange(std::string_view word, double timeout,
                                                  const Stop& gives_up,
                                                  std::span<const double> values) {
  missing_.expect(++sequence_, steady_seconds());
  const std::string message =
      word == "hello" ? line_hello(sequence_, enum_name(params_.send), sent_,
                                   static_cast<int>(std::lround(1e3 * params_.watchdog)))
                      : line_message(word, sequence_, values);
  if (connection_->stream().put(to_bytes(message), timeout, gives_up)) {
    missing_.sent();
    if (auto reply = answer(timeout, gives_up)) {
      missing_.answered();
      misses_ = 0;
      return reply;
    }
  }
  if (!interrupted_) ++misses_;
  if (!is_gone()) report_.reason = missing_.text() + last_words();
  return std::nullopt;
}

std::optional<LineReply> LineCoilDriver::answer(double timeout, const Stop& gives_up) {
  const auto began = Stop::Clock::now();
  for (;;) {
    const double left = timeout - seconds_since(began);
    if (left <= 0 || gives_up()) return std::nullopt;
    const auto byte = connection_->stream().get(std::min(left, stream_slice));
    if (!byte && is_gone()) return std::nullopt;
    if (!byte) continue;
    missing_.take(*byte);
    const auto line = reader_.take(*byte);
    auto reply = line ? parse_line_reply(*line) : std::nullopt;
    if (reply && reply->sequence == sequence_) return reply;
    if (reply) missing_.other(reply->sequence, steady_seconds());
  }
}

bool LineCoilDriver::is_gone() {
  const std::string ended = connection_->ended();
  if (ended.empty()) return false;
  gone_ = true;
  report_.reason = fmt::format("{} {}{}", connection_->name(), ended, last_words());
  return true;
}

std::string LineCoilDriver::last_words() {
  const std::string words = connection_->last_words();
  return words.empty() ? words : "; its last words: " + words;
}

}  // namespace microswarm::actuation
