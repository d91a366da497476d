// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/actuation/drivers/coil_link.hpp"
#include "tests/firmware/simulator.hpp"

namespace microswarm::test {

/// The serial line without the driver's own care.
class RawLine {
 public:
  explicit RawLine(const std::string& port) : line_(open(port.c_str(), O_RDWR | O_NOCTTY)) {
    EXPECT_GE(line_, 0);
    const auto started = next();
    EXPECT_TRUE(started && started->to == actuation::CoilMessage::started);
    if (started) last = *started;
  }
  ~RawLine() { close(line_); }
  RawLine(const RawLine&) = delete;
  RawLine& operator=(const RawLine&) = delete;

  /// The answer to these bytes.
  actuation::CoilReply ask(const std::vector<std::uint8_t>& bytes) {
    EXPECT_EQ(write(line_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    const auto reply = next();
    EXPECT_TRUE(reply);
    return last = reply.value_or(actuation::CoilReply{});
  }
  actuation::CoilReply hello() { return ask(actuation::encode_hello(++sequence)); }
  actuation::CoilReply arm() {
    return ask(actuation::encode(actuation::CoilMessage::arm, ++sequence));
  }
  actuation::CoilReply status() {
    return ask(actuation::encode(actuation::CoilMessage::status, ++sequence));
  }
  /// With a deadline so many ms after the last answer.
  actuation::CoilReply set(const actuation::CoilOutputs& outputs, int ms = 1000) {
    return ask(actuation::encode_set(++sequence, last.clock + ms, outputs));
  }

  actuation::CoilReply last;
  std::uint8_t sequence = 0;

 private:
  std::optional<actuation::CoilReply> next() {
    for (const auto began = std::chrono::steady_clock::now();
         std::chrono::steady_clock::now() < began + patience;) {
      pollfd ready{line_, POLLIN, 0};
      std::uint8_t byte = 0;
      if (poll(&ready, 1, 100) <= 0 || read(line_, &byte, 1) != 1) continue;
      if (auto reply = reader_.take(byte)) return reply;
    }
    return std::nullopt;
  }

  int line_;
  actuation::CoilReplyReader reader_;
};

/// A line of the simulator's trace: the cycle of a change, and the outputs.
struct Moment {
  double t = 0;  // [s]
  double x = 0, y = 0, z = 0;
};
inline std::vector<Moment> read_trace(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<Moment> all;
  double cycle = 0, x = 0, y = 0, z = 0, rest = 0;
  while (in >> cycle >> x >> y >> z >> rest >> rest >> rest) all.push_back({cycle / 16e6, x, y, z});
  return all;
}

}  // namespace microswarm::test
