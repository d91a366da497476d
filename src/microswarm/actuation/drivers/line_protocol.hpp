// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::actuation {

/// Version of the line protocol for user-supplied drivers: docs/reference/line-protocol.md.
inline constexpr int line_protocol_version = 1;
inline constexpr std::size_t line_protocol_values = 64;  ///< maximum number of values in a message
inline constexpr std::size_t line_protocol_length = 4096;  ///< maximum length of a line [B]

/// The driver's verdict on a message.
enum class LineVerdict : std::uint8_t { ok, limited, off, refused, emergency };

/// A reply of the driver.
struct LineReply {
  LineVerdict verdict{};
  std::uint32_t sequence = 0;    ///< of the message that it answers
  std::vector<double> values{};  ///< applied values; empty if not finite or too many
  /// Temperatures of the channels' coils by probes [°C], NaN for a coil without one; empty if the
  /// reply has none or one that is no temperature.
  std::vector<double> temperatures{};
  std::string text{};  ///< reason of off, refused and emergency, one printable line
};

/// The line "hello SEQUENCE VERSION SEND CHANNELS WATCHDOG_MS" with its end; `send` is a word.
std::string line_hello(std::uint32_t sequence, std::string_view send, std::size_t channels,
                       int watchdog_ms);
/// The line "WORD SEQUENCE VALUE VALUE …" with its end.
std::string line_message(std::string_view word, std::uint32_t sequence,
                         std::span<const double> values = {});

/// Parses a line without its end; nothing if it is no reply.
std::optional<LineReply> parse_line_reply(std::string_view line);

/// Splits a byte stream into lines, without their ends (LF or CRLF). Overlong lines are discarded.
class LineReader {
 public:
  /// Takes a byte; returns the line that it completes, if any.
  std::optional<std::string> take(std::uint8_t byte);

 private:
  std::string line_;
  bool too_long_ = false;
};

}  // namespace microswarm::actuation
