// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace microswarm {

/// The wire between host and coil driver, version 2: docs/reference/protocol.md.
inline constexpr int coil_link_version = 2;
inline constexpr int coil_link_channels = 6;
inline constexpr int coil_link_full_scale = 1000;        ///< of an output: per mille
inline constexpr int coil_link_max_frequency = 500'000;  ///< of a waveform [mHz]
inline constexpr int coil_link_unscaled = 32768;         ///< CoilReply::scale without a limit

/// What the host tells the device; `started` comes from the device when its program starts.
enum class CoilMessage : std::uint8_t { hello = 1, arm, set, stop, status, waveform, started };
/// What the device made of it.
enum class CoilResult : std::uint8_t {
  ok,
  limited,
  not_armed,
  stale,
  bad_length,
  unknown,
  wrong_version,
  out_of_range
};
/// What the device is doing; its outputs are 0 unless it is armed.
enum class CoilState : std::uint8_t { idle, armed, tripped, stopped };
/// Why the device is tripped: no obeyed message in time, or its emergency stop was open.
enum class CoilTrip : std::uint8_t { none, silence, emergency };

/// An output of each channel [per mille].
using CoilOutputs = std::array<int, coil_link_channels>;

/// What outputs follow: constant + cosine cos φ + sine sin φ [per mille], with a phase φ that turns
/// at `frequency` [mHz]. A set is one without cosine and sine.
struct CoilAim {
  int frequency = 0;
  CoilOutputs constant{}, cosine{}, sine{};
};

/// What the device answers to whatever it is told.
struct CoilReply {
  CoilMessage to{};
  std::uint8_t sequence = 0;  ///< of the message answered
  int version = 0;  ///< of the device; another than ours leaves what follows `outputs` at 0
  CoilResult result{};
  CoilState state{};
  std::uint8_t limited = 0;  ///< a bit for each channel that was beyond the device's limit
  int good = 0, bad = 0;     ///< messages since its start, modulo 65536
  int trips = 0;             ///< of its watchdog
  CoilOutputs outputs{};     ///< now [per mille]
  int clock = 0;             ///< of the device [ms], modulo 65536
  int reset_cause = 0;       ///< MCUSR at its start: bit 0 power, 1 line, 2 brown-out, 3 watchdog
  CoilTrip trip{};           ///< why it is tripped
  bool emergency_open = false;  ///< the emergency stop is open now
  int slew = 0;                 ///< change of an output beside its waveform's [per mille a ms]
  int scale = 0;                ///< applied to the aim [1 / 32768]
  int aim_sum = 0;              ///< check_sum of the scaled aim
  int phase = 0;                ///< that `outputs` belong to [turns / 65536]
};

/// CRC-16/CCITT-FALSE.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

/// A message as it goes over the wire, its end included.
std::vector<std::uint8_t> encode(CoilMessage message, std::uint8_t sequence,
                                 std::span<const std::uint8_t> payload = {});
/// Sets outputs until `deadline`, by the device's clock [ms], modulo 65536.
std::vector<std::uint8_t> encode_set(std::uint8_t sequence, int deadline,
                                     const CoilOutputs& outputs);
/// Begins a waveform at `phase` [turns / 65536], or changes the one that runs.
std::vector<std::uint8_t> encode_waveform(std::uint8_t sequence, int deadline, int phase,
                                          const CoilAim& aim);
/// A hello of this version.
std::vector<std::uint8_t> encode_hello(std::uint8_t sequence);
/// A reply as the device sends it; for what plays the device.
std::vector<std::uint8_t> encode(const CoilReply& reply);

/// An aim scaled as the device does it, by `scale` / 32768.
CoilAim scaled(const CoilAim& aim, int scale);
/// CRC-16 of an aim as the device keeps it.
std::uint16_t check_sum(const CoilAim& aim);

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
