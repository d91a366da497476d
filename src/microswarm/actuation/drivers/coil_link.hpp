// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace microswarm {

/// The wire between host and coil driver, version 1: docs/reference/protocol.md.
inline constexpr int coil_link_version = 1;
inline constexpr int coil_link_channels = 6;
inline constexpr int coil_link_full_scale = 1000;  ///< of an output: per mille

/// What the host tells the device; `started` comes from the device when its program starts.
enum class CoilMessage : std::uint8_t { hello = 1, arm, set, stop, status, started = 7 };
/// What the device made of it.
enum class CoilResult : std::uint8_t {
  ok,
  limited,
  not_armed,
  stale,
  bad_length,
  unknown,
  wrong_version
};
/// What the device is doing; its outputs are 0 unless it is armed.
enum class CoilState : std::uint8_t { idle, armed, tripped, stopped };

/// What the device answers to whatever it is told.
struct CoilReply {
  CoilMessage to{};
  std::uint8_t sequence = 0;  ///< of the message answered
  int version = 0;
  CoilResult result{};
  CoilState state{};
  std::uint8_t limited = 0;  ///< a bit for each channel that was beyond the device's limit
  int good = 0, bad = 0;     ///< messages since its start, modulo 65536
  int trips = 0;             ///< of its watchdog
  std::array<int, coil_link_channels> outputs{};  ///< now [per mille]
};

/// CRC-16/CCITT-FALSE.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

/// A message as it goes over the wire, its end included.
std::vector<std::uint8_t> encode(CoilMessage message, std::uint8_t sequence,
                                 std::span<const std::uint8_t> payload = {});
std::vector<std::uint8_t> encode_set(std::uint8_t sequence,
                                     const std::array<int, coil_link_channels>& outputs);
std::vector<std::uint8_t> encode_hello(std::uint8_t sequence);
/// A reply as the device sends it; for what plays the device.
std::vector<std::uint8_t> encode(const CoilReply& reply);

/// Content of a frame without its end and check sum: type, sequence number and payload; empty if it
/// is no frame. For what plays the device.
std::optional<std::vector<std::uint8_t>> decode(std::span<const std::uint8_t> frame);

/// Finds replies in whatever comes in. Garbage is passed over and counted.
class CoilReplyReader {
 public:
  /// A reply when this byte completes one.
  std::optional<CoilReply> take(std::uint8_t byte);
  /// Frames that were none.
  int bad() const { return bad_; }

 private:
  std::vector<std::uint8_t> frame_;
  int bad_ = 0;
};

}  // namespace microswarm
