// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "microswarm/actuation/drivers/coil_link.hpp"
#include "microswarm/core/execution/clock.hpp"

namespace microswarm::test {

/// A pseudo-terminal and what speaks at its other end.
class Pty {
 public:
  Pty() {
    termios raw{};
    cfmakeraw(&raw);
    std::array<char, 128> name{};
    if (openpty(&line_, &other_, name.data(), &raw, nullptr) != 0) ADD_FAILURE() << "no pty";
    port_ = name.data();
  }
  ~Pty() { close_line(); }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  const std::string& port() const { return port_; }
  int line() const { return line_; }
  void say(std::string_view text) const {
    EXPECT_EQ(write(line_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  /// Waits until something is said at the port.
  void await_input() const {
    pollfd ready{line_, POLLIN, 0};
    EXPECT_EQ(poll(&ready, 1, 60'000), 1);
  }
  /// Whoever has the port open finds that it has ended.
  void close_line() {
    if (line_ < 0) return;
    close(line_);
    close(other_);
    line_ = other_ = -1;
  }

 private:
  int line_ = -1, other_ = -1;
  std::string port_;
};

/// Plays the coils' device at a pseudo-terminal: arms, sets, stops. Its answers pass through
/// `answer`, which may change them; false keeps them back.
class FakeDevice {
 public:
  explicit FakeDevice(std::function<bool(actuation::CoilReply&)> answer = {})
      : answer_(std::move(answer)), thread_([this] { run(); }) {}
  ~FakeDevice() {
    ended_ = true;
    thread_.join();
  }
  FakeDevice(const FakeDevice&) = delete;
  FakeDevice& operator=(const FakeDevice&) = delete;

  const std::string& port() const { return pty_.port(); }
  /// From now on it lets at most so much through, of all channels by the same factor [per mille].
  void limit(std::size_t channel, int most) {
    const std::lock_guard lock(mutex_);
    limits_[channel] = most;
  }
  /// When a message of this kind came first [s], by steady_seconds(); 0: never.
  double first(actuation::CoilMessage message) {
    const std::lock_guard lock(mutex_);
    return first_[message];
  }
  int count(actuation::CoilMessage message) {
    const std::lock_guard lock(mutex_);
    return counts_[message];
  }

 private:
  void run() {
    std::vector<std::uint8_t> frame;
    while (!ended_) {
      pollfd ready{pty_.line(), POLLIN, 0};
      if (poll(&ready, 1, 5) <= 0) continue;
      std::array<std::uint8_t, 256> bytes{};
      const auto n = read(pty_.line(), bytes.data(), bytes.size());
      for (std::size_t k = 0; n > 0 && k < static_cast<std::size_t>(n); ++k) {
        if (bytes[k] != 0) {
          frame.push_back(bytes[k]);
          continue;
        }
        if (const auto packet = actuation::decode(frame)) obey(*packet);
        frame.clear();
      }
    }
  }

  void obey(const std::vector<std::uint8_t>& packet) {
    const auto message = static_cast<actuation::CoilMessage>(packet[0]);
    {
      const std::lock_guard lock(mutex_);
      if (first_[message] == 0) first_[message] = steady_seconds();
      ++counts_[message];
    }
    if (message == actuation::CoilMessage::hello) state_ = actuation::CoilState::idle;
    if (message == actuation::CoilMessage::arm) outputs_ = reported_ = {};
    if (message == actuation::CoilMessage::arm) state_ = actuation::CoilState::armed;
    if (message == actuation::CoilMessage::stop) state_ = actuation::CoilState::stopped;
    if (state_ != actuation::CoilState::armed) {
      outputs_ = reported_ = {};
      waveform_.reset();
    }
    if (message == actuation::CoilMessage::set) waveform_.reset();
    if (message == actuation::CoilMessage::waveform && state_ == actuation::CoilState::armed)
      turn(packet);
    if (message == actuation::CoilMessage::set && state_ == actuation::CoilState::armed)
      for (std::size_t c = 0; c < outputs_.size(); ++c)
        outputs_[c] = static_cast<std::int16_t>(packet[packet.size() - 12 + 2 * c] |
                                                packet[packet.size() - 11 + 2 * c] << 8);
    actuation::CoilReply reply;
    reply.to = message;
    reply.sequence = packet[1];
    reply.version = actuation::coil_link_version;
    reply.state = state_;
    reply.outputs = reported_;
    reply.slew = 100;
    reply.scale = actuation::coil_link_unscaled;
    reply.scale = limited_scale();
    if (reply.scale != actuation::coil_link_unscaled) reply.result = actuation::CoilResult::limited;
    const actuation::CoilAim aim = actuation::scaled({.constant = outputs_}, reply.scale);
    reply.aim_sum = actuation::check_sum(aim);
    reply.clock = static_cast<int>(1e3 * steady_seconds()) & 0xFFFF;
    reported_ = aim.constant;  // as if there at once
    if (waveform_ && state_ == actuation::CoilState::armed) {
      const double turns = phase_ + 1e-3 * waveform_->frequency * (steady_seconds() - turned_at_);
      reply.phase = static_cast<int>(std::lround(65536 * (turns - std::floor(turns)))) & 0xFFFF;
      reply.aim_sum = actuation::check_sum(*waveform_);
      const double angle = 2 * 3.14159265358979 * reply.phase / 65536;
      for (std::size_t c = 0; c < outputs_.size(); ++c)
        reply.outputs[c] = static_cast<int>(std::lround(waveform_->constant[c] +
                                                        waveform_->cosine[c] * std::cos(angle) +
                                                        waveform_->sine[c] * std::sin(angle)));
    }
    if ((message == actuation::CoilMessage::set || message == actuation::CoilMessage::waveform) &&
        state_ != actuation::CoilState::armed)
      reply.result = actuation::CoilResult::not_armed;
    if (answer_ && !answer_(reply)) return;
    const auto bytes = actuation::encode(reply);
    EXPECT_EQ(write(pty_.line(), bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }

  int limited_scale() {
    const std::lock_guard lock(mutex_);
    int scale = actuation::coil_link_unscaled;
    for (const auto& [channel, most] : limits_)
      if (const int output = std::abs(outputs_[channel]); output > most)
        scale = std::min(scale, actuation::coil_link_unscaled * most / output);
    return scale;
  }

  void turn(const std::vector<std::uint8_t>& packet) {
    const auto number = [&](std::size_t at) {
      return static_cast<std::int16_t>(packet[at] | packet[at + 1] << 8);
    };
    const double now = steady_seconds();
    phase_ = waveform_ ? phase_ + 1e-3 * waveform_->frequency * (now - turned_at_)
                       : static_cast<std::uint16_t>(number(4)) / 65536.0;
    turned_at_ = now;
    waveform_.emplace();
    waveform_->frequency = static_cast<std::uint16_t>(number(6)) | number(8) * 65536;
    for (std::size_t c = 0; c < actuation::coil_link_channels; ++c) {
      waveform_->constant[c] = number(10 + 2 * c);
      waveform_->cosine[c] = number(22 + 2 * c);
      waveform_->sine[c] = number(34 + 2 * c);
    }
  }

  std::function<bool(actuation::CoilReply&)> answer_;
  Pty pty_;
  std::atomic<bool> ended_ = false;
  std::mutex mutex_;
  std::map<actuation::CoilMessage, double> first_;
  std::map<actuation::CoilMessage, int> counts_;
  std::map<std::size_t, int> limits_;
  actuation::CoilState state_ = actuation::CoilState::idle;
  actuation::CoilOutputs outputs_{}, reported_{};
  std::optional<actuation::CoilAim> waveform_;
  double phase_ = 0, turned_at_ = 0;  // [turns] at a time [s]
  std::thread thread_;
};

}  // namespace microswarm::test
