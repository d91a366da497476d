// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace microswarm {

/// FNV-1a, 64 bits: fingerprints of inputs and records, not cryptographic. Values are hashed by
/// their bytes: two doubles hash alike only if their bits are equal.
class Hash {
 public:
  void bytes(std::span<const std::byte> data) {
    for (std::byte b : data) state_ = (state_ ^ static_cast<std::uint64_t>(b)) * 0x100000001b3ULL;
  }
  /// Hashes the length too, so "ab", "c" and "a", "bc" differ.
  void text(std::string_view s) {
    value(static_cast<std::uint64_t>(s.size()));
    bytes(std::as_bytes(std::span(s.data(), s.size())));
  }
  template <class T>
  requires((std::is_arithmetic_v<T> && sizeof(T) <= 8) || std::is_enum_v<T>) void value(T v) {
    std::byte raw[sizeof(T)];
    std::memcpy(raw, &v, sizeof(T));
    bytes(raw);
  }
  std::uint64_t digest() const { return state_; }
  /// 16 lower-case hexadecimal digits.
  std::string hex() const;

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace microswarm
