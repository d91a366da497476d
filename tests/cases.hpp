// SPDX-License-Identifier: Apache-2.0
// How much of a long test runs where it runs slowly.
#pragma once

#include <concepts>

namespace microswarm::test {

/// Whether a sanitizer watches: it looks for wrong memory and races, at ten times the cost.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// How many of `count` random cases a law is tried on: a quarter under a sanitizer, which does not
/// look for the rare ones, all of them elsewhere.
template <std::integral T>
constexpr T cases(T count) {
  return sanitized ? (count + 3) / 4 : count;
}

}  // namespace microswarm::test
