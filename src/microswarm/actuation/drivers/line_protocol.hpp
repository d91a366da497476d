// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// The lines between host and a driver of one's own, version 1: docs/reference/line-protocol.md.
inline constexpr int line_protocol_version = 1;
inline constexpr std::size_t line_protocol_values = 64;    ///< of a message, at most
inline constexpr std::size_t line_protocol_length = 4096;  ///< of a line in bytes, at most

/// What the driver made of a message.
enum class LineVerdict : std::uint8_t { ok, limited, off, refused, emergency };

/// An answer of the driver.
struct LineReply {
  LineVerdict verdict{};
  std::uint32_t sequence = 0;  ///< of the message answered
  std::vector<double> values;  ///< as applied; empty if they are no finite numbers or too many
  std::string text;            ///< of off, refused and emergency: why, in one printable line
};

/// "hello SEQUENCE VERSION SEND CHANNELS WATCHDOG_MS", with its end; `send` is a word.
std::string line_hello(std::uint32_t sequence, std::string_view send, std::size_t channels,
                       int watchdog_ms);
/// "WORD SEQUENCE VALUE VALUE …", with its end.
std::string line_message(std::string_view word, std::uint32_t sequence,
                         std::span<const double> values = {});

/// A line without its end as a reply; empty if it is none.
std::optional<LineReply> parse_line_reply(std::string_view line);

/// Finds lines in whatever comes in, without their ends (LF or CRLF). What is too long is passed
/// over to its end.
class LineReader {
 public:
  /// A line when this byte completes one.
  std::optional<std::string> take(std::uint8_t byte);

 private:
  std::string line_;
  bool too_long_ = false;
};

}  // namespace microswarm
