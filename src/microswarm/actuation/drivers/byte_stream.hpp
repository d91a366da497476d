// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "microswarm/core/execution/stop.hpp"

namespace microswarm::actuation {

/// Time between two checks for an interruption while waiting for a device [s].
inline constexpr double stream_slice = 0.01;

/// Byte stream to and from a device over non-blocking file descriptors. No call waits longer than
/// its timeout for a device that neither accepts nor sends bytes.
class ByteStream {
 public:
  /// Does not own the descriptors.
  ByteStream(int in, int out) : in_(in), out_(out) {}

  /// Writes all bytes; false after `timeout` seconds or when `gives_up` asks to stop.
  bool put(std::span<const std::uint8_t> bytes, double timeout, const Stop& gives_up);
  /// Next byte; nothing if none arrives within `timeout` seconds.
  std::optional<std::uint8_t> get(double timeout);
  /// Discards all input for `timeout` seconds.
  void discard(double timeout);
  /// Whether the other side has closed the stream, or it failed.
  bool ended() const { return ended_; }
  /// Text of its failure, to follow another text: ": Input/output error"; empty if it did not fail.
  std::string failure() const;

 private:
  void end(ssize_t n);

  int in_, out_;
  bool ended_ = false;
  int error_ = 0;  // errno
  std::array<std::uint8_t, 512> bytes_{};
  std::size_t next_ = 0, filled_ = 0;
};

}  // namespace microswarm::actuation
