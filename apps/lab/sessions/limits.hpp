// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>

namespace microswarm::lab {

/// Resource limits of the lab server.
struct Limits {
  std::size_t sessions = 8;
  std::size_t pages = 64;                  ///< number of streams
  std::size_t connections = 256;           ///< number of connections, without streams
  std::size_t unread = 128 * 1024 * 1024;  ///< bytes that a page may leave unread unread
  std::size_t unanswered = 64;  ///< pending requests of a page; further ones are not read
  std::chrono::milliseconds patience{30'000};  ///< timeout of a request, and of a silent page
  /// A session unwatched for two periods pauses; on a rig it is closed.
  std::chrono::milliseconds sweep_period{10'000};
  std::chrono::milliseconds keep{30 * 60'000};  ///< an unwatched session is kept for so long
  /// Bytes of unwatched sessions; with more, the longest unwatched is closed. One is always kept.
  std::size_t kept = 512 * 1024 * 1024;
};

}  // namespace microswarm::lab
