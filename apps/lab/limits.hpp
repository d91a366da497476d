// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>

namespace microswarm::lab {

/// What a lab bears.
struct Limits {
  std::size_t sessions = 8;
  std::size_t pages = 64;                      ///< streams
  std::size_t connections = 256;               ///< beside streams
  std::size_t unread = 128 * 1024 * 1024;      ///< bytes that a page may leave
  std::size_t unanswered = 64;                 ///< requests of a page; further ones are not read
  std::chrono::milliseconds patience{30'000};  ///< with a request, or a page that is silent
  std::chrono::milliseconds sweep_period{10'000};  ///< a session unwatched for two is closed
};

}  // namespace microswarm::lab
