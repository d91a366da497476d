// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace microswarm::actuation {

/// Version of the protocol between host and coil driver: docs/reference/protocol.md.
inline constexpr int coil_link_version = 3;
inline constexpr int coil_link_channels = 6;
inline constexpr int coil_link_full_scale = 1000;        ///< of an output: per mille
inline constexpr int coil_link_max_frequency = 500'000;  ///< of a waveform [mHz]
inline constexpr int coil_link_unscaled = 32768;         ///< CoilReply::scale without a limit
/// Marks in place of CoilReply::temperature.
inline constexpr int coil_link_no_probe = -32768, coil_link_probe_shorted = -32767,
                     coil_link_probe_open = 32767;

/// Messages of the host; `started` is sent by the device when its program starts.
enum class CoilMessage : std::uint8_t { hello = 1, arm, set, stop, status, waveform, started };
/// The device's verdict on a message.
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
/// State of the device; its outputs are 0 unless it is armed.
enum class CoilState : std::uint8_t { idle, armed, tripped, stopped };
/// Why the device tripped: no obeyed message in time, its emergency stop was open, a probe was
/// beyond the firmware's limit, or such a probe was open or shorted.
enum class CoilTrip : std::uint8_t { none, silence, emergency, hot, probe };

/// An output of each channel [per mille].
using CoilOutputs = std::array<int, coil_link_channels>;

/// Setpoint of the outputs: constant + cosine cos φ + sine sin φ [per mille], with a phase φ that
/// turns at `frequency` [mHz]. A set has neither cosine nor sine.
struct CoilAim {
  int frequency = 0;
  CoilOutputs constant{}, cosine{}, sine{};
};

/// The device's reply to a message.
struct CoilReply {
  CoilMessage to{};
  std::uint8_t sequence = 0;  ///< of the message answered
  int version = 0;            ///< of the device; if not ours, the members after `outputs` are 0
  CoilResult result{};
  CoilState state{};
  std::uint8_t limited = 0;  ///< bit mask of the channels beyond the device's limit
  int good = 0, bad = 0;     ///< messages since the device's start, modulo 65536
  int trips = 0;             ///< watchdog trips
  CoilOutputs outputs{};     ///< current outputs [per mille]
  int clock = 0;             ///< device's clock [ms], modulo 65536
  int reset_cause = 0;       ///< MCUSR at its start: bit 0 power, 1 line, 2 brown-out, 3 watchdog
  CoilTrip trip{};           ///< why it tripped
  bool emergency_open = false;  ///< whether the emergency stop is open now
  int slew = 0;                 ///< slew of an output besides its waveform [per mille per ms]
  int scale = 0;                ///< applied to the aim [1 / 32768]
  int aim_sum = 0;              ///< check_sum() of the scaled aim
  int phase = 0;                ///< phase of `outputs` [turns / 65536]
  std::uint8_t probe = 0;       ///< channel of `temperature`; the next reply has the next one
  int temperature = coil_link_no_probe;  ///< of its coil by a probe [0.1 °C], or a mark
};

/// CRC-16/CCITT-FALSE.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

/// Encodes a message for the wire, including its end.
std::vector<std::uint8_t> encode(CoilMessage message, std::uint8_t sequence,
                                 std::span<const std::uint8_t> payload = {});
/// Encodes outputs that hold until `deadline` by the device's clock [ms], modulo 65536.
std::vector<std::uint8_t> encode_set(std::uint8_t sequence, int deadline,
                                     const CoilOutputs& outputs);
/// Encodes a waveform that starts at `phase` [turns / 65536], or changes the running one.
std::vector<std::uint8_t> encode_waveform(std::uint8_t sequence, int deadline, int phase,
                                          const CoilAim& aim);
/// Encodes a hello of this version.
std::vector<std::uint8_t> encode_hello(std::uint8_t sequence);
/// Encodes a reply as the device does; for simulated devices.
std::vector<std::uint8_t> encode(const CoilReply& reply);

/// Scales an aim by `scale` / 32768, rounding as the device does.
CoilAim scaled(const CoilAim& aim, int scale);
/// CRC-16 of an aim in the device's representation.
std::uint16_t check_sum(const CoilAim& aim);

/// Content of a frame without end and checksum: type, sequence number and payload; nothing if it
/// is no frame. For simulated devices.
std::optional<std::vector<std::uint8_t>> decode(std::span<const std::uint8_t> frame);

/// Extracts replies from a byte stream. Garbage is skipped and counted.
class CoilReplyReader {
 public:
  /// Takes a byte; returns the reply that it completes, if any.
  std::optional<CoilReply> take(std::uint8_t byte);
  /// Number of invalid frames.
  int bad() const { return bad_; }

 private:
  std::vector<std::uint8_t> frame_;
  int bad_ = 0;
};

}  // namespace microswarm::actuation
