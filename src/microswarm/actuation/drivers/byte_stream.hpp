// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "microswarm/core/execution/stop.hpp"

namespace microswarm {

/// Time between looks for an interruption while a device is waited for [s].
inline constexpr double stream_slice = 0.01;

/// Bytes to and from a device through open file descriptors, which must not block. Neither call
/// waits on a device that neither accepts nor sends bytes for longer than it may.
class ByteStream {
 public:
  /// Does not own the descriptors.
  ByteStream(int in, int out) : in_(in), out_(out) {}

  /// False if not all bytes were written in `timeout` seconds, or it was given up.
  bool put(std::span<const std::uint8_t> bytes, double timeout, const Stop& gives_up);
  /// Next byte; empty if none arrives in `timeout` seconds.
  std::optional<std::uint8_t> get(double timeout);
  /// Discards what comes within so many seconds.
  void discard(double timeout);
  /// Nothing can come any more: the other side has closed.
  bool ended() const { return ended_; }

 private:
  int in_, out_;
  bool ended_ = false;
  std::array<std::uint8_t, 512> bytes_{};
  std::size_t next_ = 0, filled_ = 0;
};

}  // namespace microswarm
