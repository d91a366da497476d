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
#include <thread>
#include <vector>

#include "microswarm/actuation/drivers/coil_link.hpp"
#include "microswarm/core/execution/clock.hpp"

namespace microswarm::test {

/// Plays the coils' device at a pseudo-terminal: arms, sets, stops. Its answers pass through
/// `answer`, which may change them; false keeps them back.
class FakeDevice {
 public:
  explicit FakeDevice(std::function<bool(CoilReply&)> answer = {}) : answer_(std::move(answer)) {
    termios raw{};
    cfmakeraw(&raw);
    std::array<char, 128> name{};
    if (openpty(&line_, &other_, name.data(), &raw, nullptr) != 0) ADD_FAILURE() << "no pty";
    port_ = name.data();
    thread_ = std::thread([this] { run(); });
  }
  ~FakeDevice() {
    ended_ = true;
    thread_.join();
    close(line_);
    close(other_);
  }
  FakeDevice(const FakeDevice&) = delete;
  FakeDevice& operator=(const FakeDevice&) = delete;

  const std::string& port() const { return port_; }
  /// From now on it lets at most so much through, of all channels by the same factor [per mille].
  void limit(std::size_t channel, int most) {
    const std::lock_guard lock(mutex_);
    limits_[channel] = most;
  }
  /// When a message of this kind came first [s], by steady_seconds(); 0: never.
  double first(CoilMessage message) {
    const std::lock_guard lock(mutex_);
    return first_[message];
  }
  int count(CoilMessage message) {
    const std::lock_guard lock(mutex_);
    return counts_[message];
  }

 private:
  void run() {
    std::vector<std::uint8_t> frame;
    while (!ended_) {
      pollfd ready{line_, POLLIN, 0};
      if (poll(&ready, 1, 5) <= 0) continue;
      std::array<std::uint8_t, 256> bytes{};
      const auto n = read(line_, bytes.data(), bytes.size());
      for (std::size_t k = 0; n > 0 && k < static_cast<std::size_t>(n); ++k) {
        if (bytes[k] != 0) {
          frame.push_back(bytes[k]);
          continue;
        }
        if (const auto packet = decode(frame)) obey(*packet);
        frame.clear();
      }
    }
  }

  void obey(const std::vector<std::uint8_t>& packet) {
    const auto message = static_cast<CoilMessage>(packet[0]);
    {
      const std::lock_guard lock(mutex_);
      if (first_[message] == 0) first_[message] = steady_seconds();
      ++counts_[message];
    }
    if (message == CoilMessage::hello) state_ = CoilState::idle;
    if (message == CoilMessage::arm) outputs_ = reported_ = {};
    if (message == CoilMessage::arm) state_ = CoilState::armed;
    if (message == CoilMessage::stop) state_ = CoilState::stopped;
    if (state_ != CoilState::armed) {
      outputs_ = reported_ = {};
      waveform_.reset();
    }
    if (message == CoilMessage::set) waveform_.reset();
    if (message == CoilMessage::waveform && state_ == CoilState::armed) turn(packet);
    if (message == CoilMessage::set && state_ == CoilState::armed)
      for (std::size_t c = 0; c < outputs_.size(); ++c)
        outputs_[c] = static_cast<std::int16_t>(packet[packet.size() - 12 + 2 * c] |
                                                packet[packet.size() - 11 + 2 * c] << 8);
    CoilReply reply;
    reply.to = message;
    reply.sequence = packet[1];
    reply.version = coil_link_version;
    reply.state = state_;
    reply.outputs = reported_;
    reply.slew = 100;
    reply.scale = coil_link_unscaled;
    reply.scale = limited_scale();
    if (reply.scale != coil_link_unscaled) reply.result = CoilResult::limited;
    const CoilAim aim = scaled({.constant = outputs_}, reply.scale);
    reply.aim_sum = check_sum(aim);
    reply.clock = static_cast<int>(1e3 * steady_seconds()) & 0xFFFF;
    reported_ = aim.constant;  // as if there at once
    if (waveform_ && state_ == CoilState::armed) {
      const double turns = phase_ + 1e-3 * waveform_->frequency * (steady_seconds() - turned_at_);
      reply.phase = static_cast<int>(std::lround(65536 * (turns - std::floor(turns)))) & 0xFFFF;
      reply.aim_sum = check_sum(*waveform_);
      const double angle = 2 * 3.14159265358979 * reply.phase / 65536;
      for (std::size_t c = 0; c < outputs_.size(); ++c)
        reply.outputs[c] = static_cast<int>(std::lround(waveform_->constant[c] +
                                                        waveform_->cosine[c] * std::cos(angle) +
                                                        waveform_->sine[c] * std::sin(angle)));
    }
    if ((message == CoilMessage::set || message == CoilMessage::waveform) &&
        state_ != CoilState::armed)
      reply.result = CoilResult::not_armed;
    if (answer_ && !answer_(reply)) return;
    const auto bytes = encode(reply);
    EXPECT_EQ(write(line_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }

  int limited_scale() {
    const std::lock_guard lock(mutex_);
    int scale = coil_link_unscaled;
    for (const auto& [channel, most] : limits_)
      if (const int output = std::abs(outputs_[channel]); output > most)
        scale = std::min(scale, coil_link_unscaled * most / output);
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
    for (std::size_t c = 0; c < coil_link_channels; ++c) {
      waveform_->constant[c] = number(10 + 2 * c);
      waveform_->cosine[c] = number(22 + 2 * c);
      waveform_->sine[c] = number(34 + 2 * c);
    }
  }

  std::function<bool(CoilReply&)> answer_;
  int line_ = -1, other_ = -1;
  std::string port_;
  std::atomic<bool> ended_ = false;
  std::mutex mutex_;
  std::map<CoilMessage, double> first_;
  std::map<CoilMessage, int> counts_;
  std::map<std::size_t, int> limits_;
  CoilState state_ = CoilState::idle;
  CoilOutputs outputs_{}, reported_{};
  std::optional<CoilAim> waveform_;
  double phase_ = 0, turned_at_ = 0;  // [turns] at a time [s]
  std::thread thread_;
};

}  // namespace microswarm::test
